#include "suspension_health_monitor/internal/identification/tyre_regression.h"

namespace suspension_health_monitor {

TyreRegression::TyreRegression(const IntegralFilterOptions& options)
    : wheel_(2, options, 2),
      strut_(2, options),
      tyre_(2, options),
      row_{Eigen::VectorXd::Zero(kNumTyreParameters), 0.0} {}

const RegressionRow* TyreRegression::push(const CornerSample& sample, double road_acceleration) {
  wheel_.push(sample.unsprung_acceleration);
  strut_.push(sample.unsprung_acceleration - sample.sprung_acceleration);
  tyre_.push(road_acceleration - sample.unsprung_acceleration);
  if (!wheel_.full()) return nullptr;
  row_.output = wheel_.output(2);
  row_.regressor[kDampingToWheelMass] = -strut_.output(1);
  row_.regressor[kStiffnessToWheelMass] = -strut_.output(0);
  row_.regressor[kTyreToWheelMass] = tyre_.output(0);
  return &row_;
}

void TyreRegression::reset() {
  wheel_.reset();
  strut_.reset();
  tyre_.reset();
}

}  // namespace suspension_health_monitor
