#pragma once

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/identification/horizon_mean.h"

namespace suspension_health_monitor {

/// What is much slower than a body oscillates on its springs: a mean over 2 s, weighted by a triangle, twice. Of an
/// oscillation of 1 Hz it leaves nothing, of 0.8 Hz 0.3 %. Cost per value: O(1), no allocation.
class SlowMean {
 public:
  /// @param period  of the values [s].
  explicit SlowMean(double period) : first_(static_cast<int>(std::lround(kMean / period))), second_(first_) {}

  /// @return the mean that ends with this value; not before full().
  double push(double value) {
    values_ = std::min(values_ + 1, fills());
    return second_.push(first_.push(value));
  }

  int fills() const { return 2 * first_.fills(); }  ///< values, until it is full
  bool full() const { return values_ == fills(); }

  void reset() {
    first_.reset();
    second_.reset();
    values_ = 0;
  }

 private:
  static constexpr double kMean = 2.0;  // [s]

  HorizonMean first_, second_;
  int values_ = 0;
};

}  // namespace suspension_health_monitor
