#include "suspension_health_monitor/identification/recursive_least_absolute.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
  if (row.regressor.isZero(0.0)) return row.output;
  const double innovation = innovate(row);
  if (rows_ < absolute_.start_rows) {
    correct(row, innovation, 1.0);
    if (++rows_ == absolute_.start_rows) takeOver();
  } else {
    correct(row, innovation, 1.0 / divisor(innovation));
  }
  return innovation;
}

void RecursiveLeastAbsolute::takeOver() {
  // R(k) of LA sums phi phi' / |epsilon|, that of LS phi phi': without the factor the start depends on the unit of psi.
  if (absolute_.scale_covariance_at_start && meanAbsoluteResidual() > 0.0) covariance_.scale(meanAbsoluteResidual());
}

double RecursiveLeastAbsolute::divisor(double innovation) const {
  const bool relative = absolute_.small_divisor_rule == SmallDivisor::kRelative;
  const double smallest = absolute_.small_divisor * (relative ? meanAbsoluteResidual() : 1.0);
  // The last bound only matters for a row that is hit exactly while the threshold is 0, too.
  return std::max({std::abs(innovation), smallest, std::numeric_limits<double>::min()});
}

}  // namespace suspension_health_monitor
