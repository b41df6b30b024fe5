#pragma once

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

/// How large a sensor's readings usually are: their running median.
///
/// It is followed on a logarithmic scale by steps of one size, up for a reading above it and down for one below, so
/// that 1e300 moves it as little as the next larger reading. Readings that are wrong for a while move it by what half
/// of the readings of that time would; those that stay, as of a sensor that reads in another unit from now on, become
/// the usual ones.
/// Cost per reading: O(1), no allocation.
class UsualSize {
 public:
  /// @param period  from one reading to the next, above 0 [s].
  explicit UsualSize(double period) : slowest_step_(period / kFoldTime) {}

  /// @param size  of the next reading, finite and not negative.
  void add(double size) {
    readings_ = std::min(readings_ + 1.0, kStart / slowest_step_);
    if (median_ == 0.0) median_ = size;
    const double factor = std::exp(kStart / readings_);
    median_ = std::clamp(size > median_ ? median_ * factor : median_ / factor, kSmallest, kLargest);
  }

  /// @return the median; none as long as there are fewer than kFewest readings.
  double median() const { return readings_ >= kFewest ? median_ : 0.0; }

 private:
  static constexpr double kFoldTime = 13.0;  // [s] to e times the size, at the fastest: ten times in half a minute
  static constexpr double kStart = 5.0;      // steps 5, 5/2, 5/3, ..: a first reading of 1e12 is left after 200 more
  static constexpr double kFewest = 10.0;
  static constexpr double kSmallest = 1e-100, kLargest = 1e100;  // its logarithm stays a number

  double slowest_step_;
  double readings_ = 0.0;
  double median_ = 0.0;
};

}  // namespace suspension_health_monitor
