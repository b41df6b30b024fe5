#pragma once

#include <algorithm>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/signal/sampling_limit_power.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// How one sensor shakes at the limit of its sampling, beside what it reads on average.
/// Cost per value: O(1), no allocation.
class SensorSpectrum {
 public:
  /// @param period  of the values [s].
  /// @return that of a live judgement, which does not come and go with the road: a memory of ten seconds.
  static double liveForgetting(double period) { return 1.0 - std::min(1.0, period / 10.0); }

  /// @param forgetting_factor  lambda in (0, 1].
  explicit SensorSpectrum(double forgetting_factor) : mean_(forgetting_factor), limit_(forgetting_factor) {}

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
