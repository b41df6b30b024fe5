#include "suspension_health_monitor/internal/identification/regression.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

SuspensionRegression::SuspensionRegression(const IntegralFilterOptions& options, std::size_t num_effects,
                                           SensorColumns sensors, int effect_derivative)
    : sprung_(2, options, 2),
      relative_(2, options),
      effects_(num_effects, LinearIntegralFilter(2, options, effect_derivative)),
      effect_derivative_(effect_derivative),
      sensors_(sensors),
      offset_gain_(std::pow(options.horizon_samples * options.period, 2)),
      drift_rows_(LinearIntegralFilter::window(2, options) / 2),
      row_{Eigen::VectorXd::Zero(kNumStrutParameters + num_effects + count(sensors)), 0.0} {}

const RegressionRow* SuspensionRegression::push(const CornerSample& sample, const double* effect_forces) {
  sprung_.push(sample.sprung_acceleration);
  relative_.push(sample.unsprung_acceleration - sample.sprung_acceleration);
  for (LinearIntegralFilter& effect : effects_) effect.push(*effect_forces++);
  if (!sprung_.full()) return nullptr;
  double* column = row_.regressor.data() + kNumStrutParameters;
  row_.output = sprung_.output(2);
  row_.regressor[kDampingToMass] = relative_.output(1);
  row_.regressor[kStiffnessToMass] = relative_.output(0);
  for (const LinearIntegralFilter& effect : effects_) *column++ = effect.output(effect_derivative_);
  if (sensors_ != SensorColumns::kNone) fillSensors(column);
  return &row_;
}

void SuspensionRegression::fillSensors(double* column) {
  std::fill(column, column + count(sensors_), 0.0);
  if (row_.output == 0.0 && row_.saysNothing()) return;  // readings that are lost have no offset
  column[0] = offset_gain_;
  if (sensors_ == SensorColumns::kDriftingOffset) column[1] = -drift_rows_ * offset_gain_;
}

void SuspensionRegression::reset() {
  sprung_.reset();
  relative_.reset();
  for (LinearIntegralFilter& effect : effects_) effect.reset();
}

}  // namespace suspension_health_monitor
