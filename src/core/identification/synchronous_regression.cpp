#include "suspension_health_monitor/internal/identification/synchronous_regression.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kBodyColumns = 3;

}  // namespace

SynchronousRegression::Late::Late(const IntegralFilterOptions& options, const RegressorNoise& noise,
                                  double forgetting_factor)
    : wheel(options, SkewProfile::mostSkew(options)),
      skew(wheel, options, noise, forgetting_factor),
      place(wheel.place(0.0)) {
  setEffects(0);
}

void SynchronousRegression::Late::setEffects(std::size_t num_effects) {
  columns.assign(kBodyColumns + num_effects, DelayLine(wheel.delay() + 1));
}

SynchronousRegression::SynchronousRegression(const IntegralFilterOptions& options, SensorColumns sensors,
                                             const RegressorNoise& noise, double forgetting_factor)
    : options_(options), sensors_(sensors), rows_(options, 0, sensors) {
  if (sensors == SensorColumns::kDriftingOffset) late_.emplace(options, noise, forgetting_factor);
}

void SynchronousRegression::changeEffects(std::size_t num_effects) {
  rows_ = SuspensionRegression(options_, num_effects, sensors_);
  if (!late_) return;
  late_->setEffects(num_effects);
  reset();
}

const RegressionRow* SynchronousRegression::push(const CornerSample& sample, const double* effect_forces) {
  if (late_) late_->wheel.push(sample.unsprung_acceleration);
  const RegressionRow* newest = rows_.push(sample, effect_forces);
  if (newest == nullptr) return nullptr;
  if (late_) return synchronised(*newest);
  wheel_.output = rows_.wheelOutput();
  row_ = *newest;
  return &row_;
}

const RegressionRow* SynchronousRegression::synchronised(const RegressionRow& newest) {
  const WheelRow wheel = late_->wheel.newest();
  late_->columns[0].push(newest.output);
  late_->columns[1].push(wheel.damping - newest.regressor[kDampingToMass]);
  late_->columns[2].push(wheel.stiffness - newest.regressor[kStiffnessToMass]);
  for (std::size_t j = kBodyColumns; j < late_->columns.size(); ++j)
    late_->columns[j].push(newest.regressor[static_cast<Eigen::Index>(j) - kBodyColumns + kNumStrutParameters]);
  if (!late_->wheel.full()) return nullptr;
  wheel_ = late_->wheel.at(late_->place);
  row_.regressor = newest.regressor;
  row_.output = late_->at(0);
  row_.regressor[kDampingToMass] = wheel_.damping - late_->at(1);
  row_.regressor[kStiffnessToMass] = wheel_.stiffness - late_->at(2);
  for (std::size_t j = kBodyColumns; j < late_->columns.size(); ++j)
    row_.regressor[static_cast<Eigen::Index>(j) - kBodyColumns + kNumStrutParameters] = late_->at(j);
  return &row_;
}

void SynchronousRegression::learnSkew(double output) {
  if (!late_ || !late_->skew.add(late_->wheel, {late_->at(1), late_->at(2)}, output)) return;
  late_->place = late_->wheel.place(late_->skew.skew());
}

void SynchronousRegression::setForgettingFactor(double forgetting_factor) {
  if (late_) late_->skew.setForgettingFactor(forgetting_factor);
}

void SynchronousRegression::reset() {
  rows_.reset();
  if (!late_) return;
  late_->wheel.reset();
  late_->skew.interrupt();
}

void SynchronousRegression::restart() {
  reset();
  if (!late_) return;
  late_->skew.restart();
  late_->place = late_->wheel.place(0.0);
}

}  // namespace suspension_health_monitor
