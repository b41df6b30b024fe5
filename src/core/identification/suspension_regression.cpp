#include "suspension_health_monitor/identification/suspension_regression.h"

namespace suspension_health_monitor {

SuspensionRegression::SuspensionRegression(const IntegralFilterOptions& options)
    : sprung_(2, options, 2), relative_(2, options), row_{Eigen::VectorXd::Zero(kNumStrutParameters), 0.0} {}

const RegressionRow* SuspensionRegression::push(const CornerSample& sample) {
  sprung_.push(sample.sprung_acceleration);
  relative_.push(sample.unsprung_acceleration - sample.sprung_acceleration);
  if (!sprung_.full()) return nullptr;
  row_.output = sprung_.output(2);
  row_.regressor[kDampingToMass] = relative_.output(1);
  row_.regressor[kStiffnessToMass] = relative_.output(0);
  return &row_;
}

void SuspensionRegression::reset() {
  sprung_.reset();
  relative_.reset();
}

}  // namespace suspension_health_monitor
