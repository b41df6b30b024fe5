#pragma once

#include <algorithm>

namespace suspension_health_monitor {

/// Tells motion by the outputs of rows: without any noise there is none, but a sensor that is stuck or a simulated
/// vehicle at rest.
class SilentRows {
 public:
  /// @param most  so many outputs of exactly 0 without a break are no motion, >= 1.
  explicit SilentRows(int most) : most_(most) {}

  void add(double output) { silent_ = output == 0.0 ? std::min(silent_ + 1, most_) : 0; }

  /// @return true if there is motion in the newest row.
  bool moves() const { return silent_ < most_; }

 private:
  int most_;
  int silent_ = 0;  // counts up to most_ and stays there
};

}  // namespace suspension_health_monitor
