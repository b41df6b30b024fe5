#pragma once

namespace suspension_health_monitor {

/// Lets the first of every n calls through: for figures that are dear to make and change slowly.
class EveryN {
 public:
  /// @param n  >= 1.
  explicit EveryN(int n) : n_(n) {}

  /// @return true if this call is one of those to act upon.
  bool operator()() {
    if (left_ > 0) {
      --left_;
      return false;
    }
    left_ = n_ - 1;
    return true;
  }

 private:
  int n_;
  int left_ = 0;  // calls until the next one is let through
};

}  // namespace suspension_health_monitor
