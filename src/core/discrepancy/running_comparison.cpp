#include "suspension_health_monitor/discrepancy/running_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suspension_health_monitor {
namespace {

double deviation(const RunningMean& value, const RunningMean& square) {
  return std::sqrt(std::max(0.0, square.mean() - value.mean() * value.mean()));
}

}  // namespace

RunningComparison::RunningComparison(double forgetting_factor)
    : residual_(forgetting_factor),
      square_residual_(forgetting_factor),
      measured_(forgetting_factor),
      square_measured_(forgetting_factor) {}

void RunningComparison::add(double measured, double predicted) {
  const double residual = measured - predicted;
  residual_.add(residual);
  square_residual_.add(residual * residual);
  measured_.add(measured);
  square_measured_.add(measured * measured);
}

double RunningComparison::rmse() const { return deviation(residual_, square_residual_); }

double RunningComparison::fitPercent() const {
  const double spread = deviation(measured_, square_measured_);
  return spread > 0.0 ? 100.0 * (1.0 - rmse() / spread) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace suspension_health_monitor
