#include "suspension_health_monitor/identification/recursive_least_absolute.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {

void LeastAbsoluteOptions::validate() const {
  if (start_rows < 1)
    throw std::invalid_argument("la/start_rows = " + std::to_string(start_rows) + ", must be at least 1");
  if (!(std::isfinite(small_divisor) && small_divisor >= 0.0))
    throw std::invalid_argument("la/small_divisor = " + std::to_string(small_divisor) + ", must be at least 0");
}

RecursiveLeastAbsolute::RecursiveLeastAbsolute(int num_parameters, const RecursiveOptions& recursive,
                                               const LeastAbsoluteOptions& options)
    : RecursiveEstimator(num_parameters, recursive), absolute_(options) {
  options.validate();
}

double RecursiveLeastAbsolute::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  const double innovation = innovate(row);
  if (!leads()) {
    releaseExcited(row, meanSquareResidual(), 1.0);
    correct(row, innovation, 1.0);
    if (++rows_ == absolute_.start_rows) takeOver();
  } else {
    releaseExcited(row, meanAbsoluteResidual(), absolute_.scale_covariance_at_start ? meanAbsoluteResidual() : 1.0);
    correct(row, innovation,
            1.0 / boundedDivisor(innovation, absolute_.small_divisor_rule, absolute_.small_divisor,
                                 meanAbsoluteResidual()));
  }
  return innovation;
}

double RecursiveLeastAbsolute::parameterVariance(int i) const {
  return (leads() ? meanAbsoluteResidual() : meanSquareResidual()) * covariance_.variance(i);
}

void RecursiveLeastAbsolute::takeOver() {
  // R(k) of LA sums phi phi' / |epsilon|, that of LS phi phi': without the factor the start depends on the unit of psi.
  if (absolute_.scale_covariance_at_start && meanAbsoluteResidual() > 0.0) covariance_.scale(meanAbsoluteResidual());
}

}  // namespace suspension_health_monitor
