#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"

#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {

std::optional<double> massRatio(const StrutEstimate& strut, const WheelEstimate& tyre) {
  if (!strut.valid() || !tyre.valid()) return std::nullopt;
  return strut.damping_to_mass / tyre.damping_to_wheel_mass;
}

TyreTracker::TyreTracker(const MonitorSettings& options)
    : period_(fromSeconds(*options.sample_period)), identifier_(StrutIdentifier::ofWheel(options)) {}

const TyreReport& TyreTracker::add(const CornerSample& sample, const std::optional<double>& road_acceleration) {
  const bool usable = isUsable(sample.sprung_acceleration) && isUsable(sample.unsprung_acceleration) &&
                      road_acceleration && isUsable(*road_acceleration);
  const bool continues = !last_stamp_ || continuity(sample.stamp - *last_stamp_, period_) == Continuity::kContinues;
  if (!usable || !continues) identifier_.startNewSeries();
  last_stamp_ = sample.stamp;
  if (usable) {
    const double tyre = *road_acceleration - sample.unsprung_acceleration;
    identifier_.add({sample.stamp, sample.unsprung_acceleration, sample.sprung_acceleration}, &tyre);
  }
  report_.has_row = identifier_.hasRow();
  if (report_.has_row) identifier_.write(ls_, la_);
  report_.ls = wheelOf(ls_);
  report_.la = wheelOf(la_);
  return report_;
}

WheelEstimate TyreTracker::wheelOf(const StrutEstimate& estimate) const {
  WheelEstimate wheel;
  wheel.damping_to_wheel_mass = estimate.damping_to_mass;
  wheel.stiffness_to_wheel_mass = estimate.stiffness_to_mass;
  wheel.tyre_to_wheel_mass = estimate.coefficients[0];
  wheel.damping_to_wheel_mass_stddev = estimate.damping_to_mass_stddev;
  wheel.stiffness_to_wheel_mass_stddev = estimate.stiffness_to_mass_stddev;
  wheel.tyre_to_wheel_mass_stddev = estimate.coefficient_stddevs[0];
  wheel.effective_rows = estimate.effective_rows;
  wheel.explained = estimate.explained;
  EstimateFacts facts = identifier_.facts(estimate, of_input_);
  facts.has_row = facts.has_row && identifier_.moves();
  facts.explained = wheel.explained;
  // A real wheel has three positive parameters.
  facts.is_physical = facts.is_physical && wheel.tyre_to_wheel_mass > 0.0;
  wheel.doubt = doubtOf(facts);
  return wheel;
}

}  // namespace suspension_health_monitor
