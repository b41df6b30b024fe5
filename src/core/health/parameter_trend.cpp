#include "suspension_health_monitor/health/parameter_trend.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

void ParameterTrend::follow(double value, double stddev) {
  if (steps_ == 0.0 || !(std::abs(value - level()) <= kStep * stddev)) {
    once_ = twice_ = value;
    steps_ = 0.0;
  }
  steps_ += 1.0;
  const double gain = std::max(gain_, 1.0 / steps_);  // a plain mean until there are as many values as the memory
  once_ += gain * (value - once_);
  twice_ += gain * (once_ - twice_);
}

void ParameterTrend::coast() {
  const double slope = gain_ / (1.0 - gain_) * (once_ - twice_);
  once_ += slope;
  twice_ += slope;
}

std::optional<double> ParameterTrend::now() const {
  if (steps_ == 0.0) return std::nullopt;
  return level() + lag_ * gain_ / (1.0 - gain_) * (once_ - twice_);
}

}  // namespace suspension_health_monitor
