#include "suspension_health_monitor/internal/health/early_warning.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

EarlyWarning::EarlyWarning(double reference, double values_between_false_alarms)
    : reference_(reference), threshold_(std::log(2.0 * values_between_false_alarms)) {}

bool EarlyWarning::add(double change, double stddev) {
  if (!(stddev > 0.0)) return isOn();
  const double gain = 2.0 * reference_ / (stddev * stddev);
  fall_.add(gain * (-change - reference_), threshold_);
  rise_.add(gain * (change - reference_), threshold_);
  return isOn();
}

void EarlyWarning::Sum::add(double step, double threshold) {
  value = std::clamp(value + step, 0.0, 2.0 * threshold);  // an upper end, so that it comes back after a repair
  if (value >= threshold) on = true;
  if (value == 0.0) on = false;
}

}  // namespace suspension_health_monitor
