#pragma once

#include <array>
#include <cstddef>

namespace suspension_health_monitor {

/// The newest N values of a series, the oldest first, side by side in memory. Cost per value: O(1), no allocation.
template <std::size_t N>
class SlidingWindow {
 public:
  void push(double value) {
    newest_ = newest_ + 1 == N ? 0 : newest_ + 1;
    values_[newest_] = values_[newest_ + N] = value;
    if (size_ < N) ++size_;
  }

  void clear() { size_ = 0; }
  bool full() const { return size_ == N; }

  /// @pre full().
  const double* data() const { return &values_[newest_ + 1]; }

  double newest() const { return values_[newest_]; }

 private:
  std::array<double, 2 * N> values_{};  // every value twice, N apart: always N in a row
  std::size_t newest_ = N - 1;          // its first place, < N
  std::size_t size_ = 0;
};

}  // namespace suspension_health_monitor
