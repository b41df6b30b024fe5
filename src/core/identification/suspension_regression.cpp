#include "suspension_health_monitor/internal/identification/suspension_regression.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

SuspensionRegression::SuspensionRegression(const IntegralFilterOptions& options, std::size_t num_effects,
                                           SensorColumns sensors)
    : sprung_(2, options, sensors == SensorColumns::kSkewAndOffsets ? 1 : 2),
      relative_(2, options),
      effects_(num_effects, LinearIntegralFilter(2, options, 2)),
      sensors_(sensors),
      offset_gain_(std::pow(options.horizon_samples * options.period, 2)),
      drift_rows_(options.horizon_samples),
      period_(options.period),
      row_{Eigen::VectorXd::Zero(kNumStrutParameters + static_cast<Eigen::Index>(num_effects) + count(sensors)), 0.0} {}

const RegressionRow* SuspensionRegression::push(const CornerSample& sample, const double* effect_forces) {
  sprung_.push(sample.sprung_acceleration);
  relative_.push(sample.unsprung_acceleration - sample.sprung_acceleration);
  for (LinearIntegralFilter& effect : effects_) effect.push(*effect_forces++);
  if (!sprung_.full()) return nullptr;
  double* column = row_.regressor.data() + kNumStrutParameters;
  row_.output = sprung_.output(2);
  row_.regressor[kDampingToMass] = relative_.output(1);
  row_.regressor[kStiffnessToMass] = relative_.output(0);
  for (const LinearIntegralFilter& effect : effects_) *column++ = effect.output(2);
  if (sensors_ == SensorColumns::kSkewAndOffsets) keepWheel();
  if (sensors_ != SensorColumns::kNone) fillSensors(column);
  return &row_;
}

void SuspensionRegression::keepWheel() {
  // Of a wheel that stands rounding is left, by which no skew is told.
  const auto sum = [](double a, double b) {
    constexpr double kRounding = 1e-9;
    return std::abs(a + b) > kRounding * std::abs(a) ? a + b : 0.0;
  };
  const Eigen::Vector2d wheel(sum(row_.output, relative_.output(2)), sum(sprung_.output(1), relative_.output(1)));
  if (!has_wheel_) wheel_.fill(wheel);
  has_wheel_ = true;
  wheel_ = {wheel, wheel_[0], wheel_[1]};
}

void SuspensionRegression::fillSensors(double* column) {
  std::fill(column, column + count(sensors_), 0.0);
  if (row_.output == 0.0 && row_.saysNothing()) return;  // readings that are lost have no offset
  if (sensors_ == SensorColumns::kSkewAndOffsets) {
    // The derivative at the newest of three rows, exact on parabolas.
    const Eigen::Vector2d change = (3.0 * wheel_[0] - 4.0 * wheel_[1] + wheel_[2]) / (2.0 * period_);
    skew_ = {strut_.dot(wheel_[0]), strut_.dot(wheel_[0] - wheel_[1])};
    *column++ = skew_.column + 0.5 * known_skew_ * strut_.dot(change);
    column[1] = -drift_rows_ * offset_gain_;
  }
  *column = offset_gain_;
}

void SuspensionRegression::reset() {
  sprung_.reset();
  relative_.reset();
  for (LinearIntegralFilter& effect : effects_) effect.reset();
  has_wheel_ = false;
}

}  // namespace suspension_health_monitor
