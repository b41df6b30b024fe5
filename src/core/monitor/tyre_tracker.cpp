#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"

#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {
namespace {

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
  estimate.explained = estimator.explained();
}

bool isWheel(const WheelEstimate& estimate) {
  return estimate.damping_to_wheel_mass > 0.0 && estimate.stiffness_to_wheel_mass > 0.0 &&
         estimate.tyre_to_wheel_mass > 0.0;
}

}  // namespace

std::optional<double> massRatio(const StrutEstimate& strut, const WheelEstimate& tyre) {
  if (!strut.valid() || !tyre.valid()) return std::nullopt;
  return strut.damping_to_mass / tyre.damping_to_wheel_mass;
}

TyreTracker::TyreTracker(const MonitorSettings& options)
    : horizon_samples_(options.tyreFilter(*options.sample_period).horizon_samples),
      period_(fromSeconds(*options.sample_period)),
      fewest_rows_(options.fewestRows(kFewestHorizons, *options.sample_period)),
      silent_rows_(horizon_samples_),
      regression_(options.tyreFilter(*options.sample_period)),
      least_squares_(kNumTyreParameters, options.recursive(2 * horizon_samples_)),
      least_absolute_(kNumTyreParameters, options.recursive(2 * horizon_samples_)) {}

const TyreReport& TyreTracker::add(const CornerSample& sample, const std::optional<double>& road_acceleration) {
  report_.has_row = false;
  const bool usable = isUsable(sample.sprung_acceleration) && isUsable(sample.unsprung_acceleration) &&
                      road_acceleration && isUsable(*road_acceleration);
  const bool continues = !last_stamp_ || continuity(sample.stamp - *last_stamp_, period_) == Continuity::kContinues;
  if (!usable || !continues) {
    regression_.reset();
    least_squares_.interrupt();
    least_absolute_.interrupt();
  }
  last_stamp_ = sample.stamp;
  if (usable)
    if (const RegressionRow* row = regression_.push(sample, *road_acceleration)) estimate(*row);
  judge();
  return report_;
}

void TyreTracker::estimate(const RegressionRow& row) {
  report_.has_row = true;
  silent_rows_.add(row.output);
  if (!silent_rows_.moves()) return;
  least_squares_.update(row);
  least_absolute_.update(row);
  describe(least_squares_, report_.ls);
  describe(least_absolute_, report_.la);
}

void TyreTracker::judge() {
  for (WheelEstimate* estimate : {&report_.ls, &report_.la}) {
    EstimateFacts facts;
    facts.period_fits = period_fits_;
    facts.has_row = report_.has_row && silent_rows_.moves();
    facts.rows = estimate->effective_rows;
    facts.fewest_rows = fewest_rows_;
    facts.explained = estimate->explained;
    facts.is_physical = isWheel(*estimate);
    estimate->doubt = doubtOf(facts);
  }
}

}  // namespace suspension_health_monitor
