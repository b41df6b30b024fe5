#include "suspension_health_monitor/internal/identification/regression.h"

#include <cmath>

namespace suspension_health_monitor {

SuspensionRegression::SuspensionRegression(const IntegralFilterOptions& options, std::size_t num_effects,
                                           bool drifting_offset, int effect_derivative)
    : sprung_(2, options, 2),
      relative_(2, options),
      effects_(num_effects, LinearIntegralFilter(2, options, effect_derivative)),
      effect_derivative_(effect_derivative),
      drifting_offset_(drifting_offset),
      offset_gain_(std::pow(options.horizon_samples * options.period, 2)),
      drift_rows_(LinearIntegralFilter::window(2, options) / 2),
      row_{Eigen::VectorXd::Zero(kNumStrutParameters + num_effects + (drifting_offset ? 2 : 0)), 0.0} {}

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
  if (!drifting_offset_) return &row_;
  column[0] = column[1] = 0.0;
  if (row_.output == 0.0 && row_.saysNothing()) return &row_;  // readings that are lost have no offset
  column[0] = offset_gain_;
  column[1] = -drift_rows_ * offset_gain_;
  return &row_;
}

void SuspensionRegression::reset() {
  sprung_.reset();
  relative_.reset();
  for (LinearIntegralFilter& effect : effects_) effect.reset();
}

}  // namespace suspension_health_monitor
