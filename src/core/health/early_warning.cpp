#include "suspension_health_monitor/health/early_warning.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kOvershoot = 1.166;  // of a normal random walk over the threshold, Siegmund's 2 * 0.583

// b of N = 2 (exp(b) - b - 1), k = 1/2, by Newton's method from above: the function is convex, so that it converges.
double thresholdFor(double values) {
  double b = std::log(values / 2.0 + 1.0) + 5.0;
  for (int i = 0; i < 60; ++i) b -= (2.0 * (std::exp(b) - b - 1.0) - values) / (2.0 * (std::exp(b) - 1.0));
  return std::max(b - kOvershoot, 0.5);
}

}  // namespace

EarlyWarning::EarlyWarning(double reference, double values_between_false_alarms)
    : reference_(reference), threshold_(thresholdFor(2.0 * values_between_false_alarms)) {}

bool EarlyWarning::add(double change, double stddev) {
  if (!(stddev > 0.0)) return isOn();
  const double reference = std::max(reference_, 0.5 * stddev);
  fall_.add((-change - reference) / stddev, threshold_);
  rise_.add((change - reference) / stddev, threshold_);
  return isOn();
}

void EarlyWarning::Sum::add(double step, double threshold) {
  value = std::clamp(value + step, 0.0, 2.0 * threshold);  // an upper end, so that it comes back after a repair
  if (value >= threshold) on = true;
  if (value == 0.0) on = false;
}

}  // namespace suspension_health_monitor
