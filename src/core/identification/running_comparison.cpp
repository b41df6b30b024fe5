#include "suspension_health_monitor/internal/identification/running_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suspension_health_monitor {

RunningComparison::RunningComparison(double forgetting_factor)
    : means_(forgetting_factor),
      residual_(forgetting_factor),
      measured_(forgetting_factor),
      worse_(forgetting_factor),
      half_weight_(0.5 / (1.0 - std::min(forgetting_factor, 1.0 - 1e-12))) {}

void RunningComparison::add(double measured, double predicted) {
  const double residual = measured - predicted;
  means_.add({residual, residual * residual, measured, measured * measured});
  residual_.add(residual);
  measured_.add(measured);
  worse_.add(std::abs(residual - residual_.mean()) > std::abs(measured - measured_.mean()) ? 1.0 : 0.0);
}

double RunningComparison::deviation(Mean value, Mean square) const {
  return std::sqrt(std::max(0.0, means_.mean(square) - means_.mean(value) * means_.mean(value)));
}

double RunningComparison::rmse() const { return deviation(kResidual, kSquareResidual); }

double RunningComparison::fitPercent(double rmse) const {
  const double spread = deviation(kMeasured, kSquareMeasured);
  return spread > 0.0 ? 100.0 * (1.0 - rmse / spread) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace suspension_health_monitor
