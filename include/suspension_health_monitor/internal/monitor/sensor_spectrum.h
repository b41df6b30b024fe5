#pragma once

#include <algorithm>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/signal/sampling_limit_power.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// How one sensor shakes at the limit of its sampling of late, beside what it reads on average.
/// Cost per value: O(1), no allocation.
class SensorSpectrum {
 public:
  /// @param period  of the values [s].
  /// @return lambda of a memory of ten seconds: a judgement does not come and go with the road.
  static double forgettingFactor(double period) { return 1.0 - std::min(1.0, period / 10.0); }

  /// @param period  of the values [s].
  explicit SensorSpectrum(double period) : mean_(forgettingFactor(period)), limit_(forgettingFactor(period)) {}

  /// @param continues  it follows the value before.
  void add(double value, bool continues) {
    if (!continues) limit_.startNewSeries();
    mean_.add(value);
    limit_.add(value - mean_.mean());
  }

  InputStatus::SamplingLimit samplingLimit() const { return {limit_.density(), limit_.level()}; }

 private:
  LimitedMean mean_;
  SamplingLimitPower limit_;
};

}  // namespace suspension_health_monitor
