#pragma once

#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// Whether the readings of a stream were taken regularly, or when their stamps say. With d_k the distance of a stamp
/// from the regular time and a share b of it true, a reading is x_k = x(regular) + b x' d_k. Fourth differences D take
/// a slow signal out of that: D x_k = b D (x'_k d_k). b is the slope of this regression over the newest 10 000
/// readings, by an instrumental variable: x' from the readings next to x_k, and from those after them, which have other
/// noise. Cost per reading: O(1), no allocation.
class SamplingTest {
 public:
  /// Takes in the next reading.  @param off  d_k, in periods.
  void add(double value, double off);

  /// Readings are missing before the next one.
  void interrupt() { in_a_row_ = 0; }

  /// @return true if b is below 1/2, or above it, by kProven standard deviations.
  bool isRegular() const { return less_than_half_ > 0; }
  bool isAsStamped() const { return less_than_half_ < 0; }

 private:
  static constexpr int kReach = 2;  // of a derivative, to either side
  static constexpr int kHalf = 2;   // of a fourth difference
  static constexpr int kWindow = 2 * (kReach + kHalf) + 1;

  DelayLine values_{kWindow}, off_{kWindow};
  RunningMeans<4> products_{0.9999};  // i r, i e, i^2, e^2 with e = D x_k, r = D (x'_k d_k) and its instrument i
  int in_a_row_ = 0;
  int less_than_half_ = 0;  // 1: b is, -1: it is more, 0: who knows
};

}  // namespace suspension_health_monitor
