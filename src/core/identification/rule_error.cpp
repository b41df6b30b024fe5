#include "suspension_health_monitor/internal/identification/rule_error.h"

#include <algorithm>
#include <cmath>

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
  for (std::size_t k = 0; k < corrections_.size(); ++k) sum += corrections_[k] * std::sin(w * static_cast<double>(k));
  return w * sum - 1.0;
}

}  // namespace suspension_health_monitor
