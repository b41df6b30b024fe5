#include "suspension_health_monitor/internal/identification/rule_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

// The corrections of an end are those of a horizon that is long enough to keep its two ends apart.
RuleError::RuleError(const IntegralFilterOptions& filter) {
  constexpr int kApart = 32;
  HorizonIntegral integral(std::max(filter.horizon_samples, kApart), 1.0, filter.rule);
  DelayLine reading(integral.requiredHistory());
  for (int k = 0; k < kApart / 2; ++k) {
    reading.push(k == 0 ? 1.0 : 0.0);
    corrections_.push_back(integral.update(reading) - 1.0);
  }
}

double RuleError::at(double w) const {
  double sum = 0.5 / std::tan(w / 2.0);
  const double twice = 2.0 * std::cos(w);
  double before = -std::sin(w), sine = 0.0;  // of (k - 1) w and k w; sin((k + 1) w) = 2 cos w sin kw - sin((k - 1) w)
  for (const double correction : corrections_) {
    sum += correction * sine;
    before = std::exchange(sine, twice * sine - before);
  }
  return w * sum - 1.0;
}

}  // namespace suspension_health_monitor
