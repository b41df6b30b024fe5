#pragma once

#include <cmath>

#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

namespace suspension_health_monitor {

/// What of a signal is slower than a strut moves: the mean of the mean of the mean over a natural period. It has no
/// phase and is late by delayOf(). Cost per sample: O(1), no allocation.
class SlowMean {
 public:
  /// @param period  T [s].  @param natural_period  [samples], even.
  SlowMean(double period, int natural_period)
      : horizon_(std::pow(natural_period * period, kMeans)),
        filter_(kMeans, {natural_period, period, IntegrationRule::kTrapezoid}, 0) {}

  static int delayOf(int natural_period) { return kMeans * natural_period / 2; }  ///< [samples]

  void push(double value) { filter_.push(value); }
  bool full() const { return filter_.full(); }
  double value() const { return filter_.output(0) / horizon_; }
  void reset() { filter_.reset(); }

 private:
  static constexpr int kMeans = 3;

  double horizon_;
  LinearIntegralFilter filter_;
};

}  // namespace suspension_health_monitor
