#pragma once

#include <algorithm>

#include "suspension_health_monitor/internal/identification/horizon_integral.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// A mean over a horizon, weighted by a triangle: the mean over half of it, twice. Of a tone of n oscillations per
/// horizon it leaves (2 / (pi n))^2 at most, where equal weights leave 1 / (pi n): an engine is none of it.
/// Cost per value: O(1), no allocation.
class HorizonMean {
 public:
  /// @param horizon_samples  L >= 1.
  explicit HorizonMean(int horizon_samples)
      : half_(std::max(1, horizon_samples / 2)),
        first_(half_, 1.0 / half_, IntegrationRule::kTrapezoid),
        second_(first_),
        values_(first_.requiredHistory()),
        means_(values_) {}

  /// @return the mean that ends with this value; not before fills() values have come.
  double push(double value) {
    values_.push(value);
    means_.push(first_.update(values_));
    return second_.update(means_);
  }

  int fills() const { return 2 * half_ + 1; }

  void reset() {
    first_.reset();
    second_.reset();
    values_.reset();
    means_.reset();
  }

 private:
  int half_;
  HorizonIntegral first_, second_;
  DelayLine values_, means_;
};

}  // namespace suspension_health_monitor
