#pragma once

#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/sliding_window.h"

namespace suspension_health_monitor {

/// Whether the readings of a stream were taken regularly, or when their stamps say. With d_k the distance of a stamp
/// from the regular time and a share b of it true, a reading is x_k = x(regular) + b x' d_k. Fourth differences D take
/// a slow signal out of that: D x_k = b D (x'_k d_k), and b is the slope of this regression over the newest 1000
/// readings. Cost per reading: O(1), no allocation.
class SamplingTest {
 public:
  /// Takes in the next reading.  @param off  d_k, in periods.
  void add(double value, double off);

  /// Readings are missing before the next one.
  void interrupt() { in_a_row_ = 0; }

  /// @return true if b is below 1/2 by kSignificant standard deviations.
  bool isRegular() const { return is_regular_; }

 private:
  static constexpr int kReach = 3;  // of a derivative, to either side
  static constexpr int kHalf = 2;   // of a fourth difference
  static constexpr int kWindow = 2 * (kReach + kHalf) + 1;

  SlidingWindow<kWindow> values_, off_;
  RunningMeans<3> products_{0.9999};  // r^2, r e, e^2 with e = D x_k, r = D (x'_k d_k)
  int in_a_row_ = 0;
  bool is_regular_ = false;
};

}  // namespace suspension_health_monitor
