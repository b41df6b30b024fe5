#include "suspension_health_monitor/tyre_tracker.h"

#include "suspension_health_monitor/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr double kWindowsOfRest = 3.0;  // without a valid estimate

template <class Estimator>
void describe(const Estimator& estimator, WheelEstimate& estimate) {
  const Eigen::VectorXd& theta = estimator.parameters();
  const auto stddev = [&](int i) { return std::sqrt(estimator.parameterVariance(i)); };
  estimate.damping_to_wheel_mass = theta[kDampingToWheelMass];
  estimate.stiffness_to_wheel_mass = theta[kStiffnessToWheelMass];
  estimate.tyre_to_wheel_mass = theta[kTyreToWheelMass];
  estimate.damping_to_wheel_mass_stddev = stddev(kDampingToWheelMass);
  estimate.stiffness_to_wheel_mass_stddev = stddev(kStiffnessToWheelMass);
  estimate.tyre_to_wheel_mass_stddev = stddev(kTyreToWheelMass);
  estimate.effective_rows = estimator.effectiveRows();
  estimate.explained = explained(estimator);
}

bool isWheel(const WheelEstimate& estimate) {
  return estimate.damping_to_wheel_mass > 0.0 && estimate.stiffness_to_wheel_mass > 0.0 &&
         estimate.tyre_to_wheel_mass > 0.0;
}

}  // namespace

std::optional<double> massRatio(const StrutEstimate& strut, const WheelEstimate& tyre) {
  if (!strut.valid || !tyre.valid) return std::nullopt;
  return strut.damping_to_mass / tyre.damping_to_wheel_mass;
}

TyreTracker::TyreTracker(const MonitorOptions& options)
    : filter_(options.tyreFilter(*options.sample_period)),
      period_(fromSeconds(*options.sample_period)),
      valid_min_rows_(options.valid_min_rows),
      min_rows_(fewestRows(valid_min_rows_, options.forgetting_factor)),
      min_explained_(options.valid_min_explained),
      motion_(filter_.horizon_samples),
      regression_(filter_),
      least_squares_(kNumTyreParameters, options.recursive(2 * filter_.horizon_samples)),
      least_absolute_(kNumTyreParameters, options.recursive(2 * filter_.horizon_samples), options.leastAbsolute()) {}

const TyreReport& TyreTracker::add(const CornerSample& sample, const std::optional<double>& road_acceleration) {
  report_.has_row = false;
  const bool usable = isUsable(sample.sprung_acceleration) && isUsable(sample.unsprung_acceleration) &&
                      road_acceleration && isUsable(*road_acceleration);
  if (!usable || !continues(sample.stamp)) startNewSeries();
  last_stamp_ = sample.stamp;
  if (!usable) return report_;
  if (const RegressionRow* row = regression_.push(sample, *road_acceleration)) estimate(*row);
  return report_;
}

void TyreTracker::reconfigure(const MonitorOptions& options) {
  least_squares_.setForgettingFactor(options.forgetting_factor);
  least_absolute_.setForgettingFactor(options.forgetting_factor);
  min_rows_ = fewestRows(valid_min_rows_, options.forgetting_factor);
}

bool TyreTracker::continues(Stamp stamp) const {
  return !last_stamp_ || continuity(stamp - *last_stamp_, period_) == Continuity::kContinues;
}

void TyreTracker::estimate(const RegressionRow& row) {
  report_.has_row = true;
  const bool moves = motion_.moves(row.output);
  if (moves) {
    least_squares_.update(row);
    least_absolute_.update(row);
    describe(least_squares_, report_.ls);
    describe(least_absolute_, report_.la);
  }
  for (WheelEstimate* estimate : {&report_.ls, &report_.la})
    estimate->valid = moves && period_fits_ && estimate->effective_rows >= min_rows_ &&
                      estimate->explained >= min_explained_ && isWheel(*estimate);
  noteValidity();
}

// How the estimates scatter was learned in vain while there was nothing to estimate: the vehicle stood.
void TyreTracker::noteValidity() {
  if (!report_.la.valid) {
    invalid_rows_ += 1.0;
    return;
  }
  if (invalid_rows_ > kWindowsOfRest * 2.0 * filter_.horizon_samples) {
    least_squares_.beginSpread();
    least_absolute_.beginSpread();
  }
  invalid_rows_ = 0.0;
}

void TyreTracker::startNewSeries() {
  regression_.reset();
  least_squares_.interrupt();
  least_absolute_.interrupt();
  report_.ls.valid = report_.la.valid = false;
}

}  // namespace suspension_health_monitor
