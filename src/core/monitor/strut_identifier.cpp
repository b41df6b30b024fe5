#include "suspension_health_monitor/internal/monitor/strut_identifier.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace suspension_health_monitor {
namespace {

constexpr double kMemoriesToForget = 2.0;  // until rows that are wrong count for a seventh

RecursiveOptions recursiveOf(const MonitorSettings& options, int horizon_samples) {
  RecursiveOptions recursive = options.recursive(2 * horizon_samples);
  if (options.estimators.sensors == SensorColumns::kDriftingOffset) recursive.drifting = kStiffnessToMass;
  return recursive;
}

RegressorNoise regressorNoise(const MonitorSettings& options, const IntegralFilterOptions& filter) {
  return options.estimators.noise ? RegressorNoise(filter, *options.estimators.noise) : RegressorNoise(filter);
}

// @param num_model  columns of the strut and of its effects, before those of the sensors.
// @param shift  by the sensors' noise, of each parameter.
void describeParameters(const RecursiveEstimator& estimator, const Eigen::VectorXd& shift, int num_model,
                        StrutEstimate& estimate) {
  if (!(estimator.effectiveRows() > 0.0)) return;  // the start values are no estimates
  const Eigen::VectorXd& theta = estimator.parameters();
  estimate.damping_to_mass = theta[kDampingToMass] - shift[kDampingToMass];
  estimate.stiffness_to_mass = theta[kStiffnessToMass] - shift[kStiffnessToMass];
  estimate.num_effects = static_cast<std::size_t>(num_model - kNumStrutParameters);
  for (std::size_t j = 0; j < estimate.num_effects; ++j) {
    const auto i = kNumStrutParameters + static_cast<Eigen::Index>(j);
    estimate.coefficients[j] = theta[i] - shift[i];
  }
  if (num_model < estimator.numParameters()) estimate.offset = -theta[num_model] / theta[kStiffnessToMass];
  estimate.effective_rows = estimator.effectiveRows();
  estimate.explained = estimator.explained();
  estimate.scatter_is_known = estimator.knowsScatter();
}

}  // namespace

StrutIdentifier::StrutIdentifier(const MonitorSettings& options)
    : filter_(options.filter(*options.sample_period)),
      forgets_unexcited_(options.estimators.forgets_unexcited),
      excitation_(filter_.horizon_samples, options.forgettingFactor(filter_.period), regressorNoise(options, filter_)),
      regression_(filter_, options.estimators.sensors, excitation_.noise(), options.forgettingFactor(filter_.period)),
      estimators_(options.estimators.sensors, recursiveOf(options, filter_.horizon_samples), options.leastAbsolute()),
      errors_(filter_, excitation_.noise(), estimators_.leastSquares().numParameters(),
              options.forgettingFactor(filter_.period), options.estimators.removes_noise_shift),
      friction_(filter_, regression_.delay(), options.forgettingFactor(filter_.period)),
      silent_rows_(filter_.horizon_samples),
      rows_(std::numeric_limits<double>::infinity()) {  // the plain columns are there from the first row on
  setForgetting(options);
}

void StrutIdentifier::changeEffects(const std::vector<ColumnOrigin>& effects) {
  errors_.changeColumns(estimators_.changeEffects(effects));
  regression_.changeEffects(effects.size());
  takeExcitation();
  has_row_ = false;
  rows_ = 0.0;
}

void StrutIdentifier::add(const CornerSample& sample, const double* effect_forces) {
  errors_.addSample(sample, !estimators_.leastSquares().holdsAny());
  friction_.addSample(sample.unsprung_acceleration - sample.sprung_acceleration);
  const RegressionRow* row = regression_.push(sample, effect_forces);
  has_row_ = row != nullptr;
  if (!has_row_) return;
  silent_rows_.add(row->output);
  // Rows that LA hits exactly would weigh so much that it could not leave them for minutes.
  if (!silent_rows_.moves()) return;
  rows_ += 1.0;
  const double output = estimators_.withoutEffects(*row);
  if (excitation_.add(*row, output, regression_.wheel().output)) takeExcitation();
  if (!holdsAll()) regression_.learnSkew(output);
  // Rows of a skew that nobody knows would bring the estimates where they had to come back from.
  if (regression_.skew() == nullptr || regression_.skew()->isKnown()) update(*row);
}

bool StrutIdentifier::holdsAll() const {
  const bool excited = excitation_.excited(kDampingToMass) || excitation_.excited(kStiffnessToMass);
  return !forgets_unexcited_ && (!excited || (excitation_.outsideForce() && excitation_.knowsStrut()));
}

void StrutIdentifier::update(const RegressionRow& row) {
  if (holdsAll()) return estimators_.observe(row);
  rows_to_forget_ = std::max(0.0, rows_to_forget_ - 1.0);
  if (const SkewProfile* skew = regression_.skew())
    errors_.addSkew(row, regression_.wheel(), skew->skew(), estimators_.leastAbsolute());
  const double innovation = estimators_.update(row);
  errors_.addRow(row, innovation, estimators_.leastAbsolute());
  friction_.setForgettingFactor(estimators_.forgettingFactor());
  friction_.addRow(row, innovation, estimators_.leastAbsolute());
}

void StrutIdentifier::takeExcitation() {
  if (excitation_.outsideForce()) rows_to_forget_ = kMemoriesToForget * estimators_.leastAbsolute().effectiveRows();
  estimators_.hold(isHeld(kDampingToMass), isHeld(kStiffnessToMass));
}

void StrutIdentifier::noteValidity(const StrutEstimate& ls, const StrutEstimate& la) {
  estimators_.noteValidity(ls.valid(), la.valid());
  if (la.valid()) excitation_.know({la.damping_to_mass, la.stiffness_to_mass});
  errors_.noteValidity(la);
}

void StrutIdentifier::describe(StrutEstimate& ls, StrutEstimate& la) {
  describeParameters(estimators_.leastSquares(), errors_.noiseShift(), estimators_.numModelColumns(), ls);
  describeParameters(estimators_.leastAbsolute(), errors_.noiseShift(), estimators_.numModelColumns(), la);
  for (StrutEstimate* estimate : {&ls, &la}) {
    estimate->damping_excitation = excitation_.excitation(kDampingToMass);
    estimate->stiffness_excitation = excitation_.excitation(kStiffnessToMass);
    if (regression_.skew() != nullptr) estimate->clock_skew = regression_.skew()->skew();
  }
  if (holdsAll()) return;
  errors_.describe(estimators_, regression_.skew(), ls, la);
  ls.friction = la.friction = friction_.friction(estimators_.leastSquares());
  regression_.setNoise(errors_.noiseVariance());
}

EstimateFacts StrutIdentifier::facts(const StrutEstimate& estimate) const {
  EstimateFacts facts;
  facts.has_row = has_row_;
  facts.sensor_moves = silent_rows_.moves();
  facts.rows = std::min(estimate.effective_rows, rows_);
  facts.fewest_rows = fewest_rows_;
  facts.excites_damping = !isHeld(kDampingToMass);
  facts.excites_stiffness = !isHeld(kStiffnessToMass);
  (errors_.isWrongByLevel() ? facts.level_share : facts.wrong_share) = errors_.wrongShare();
  facts.outside_force = rows_to_forget_ > 0.0;
  facts.explained = errors_.explainedBesideNoise(estimate);
  facts.is_physical = estimate.damping_to_mass > 0.0 && estimate.stiffness_to_mass > 0.0;
  facts.skew_is_known = regression_.skew() == nullptr || regression_.skew()->isWithin();
  facts.has_stddev = std::isfinite(estimate.damping_to_mass_stddev + estimate.stiffness_to_mass_stddev);
  return facts;
}

void StrutIdentifier::startNewSeries() {
  regression_.reset();
  estimators_.interrupt();
  errors_.interrupt();
  friction_.interrupt();
  excitation_.reset();
  has_row_ = false;
}

void StrutIdentifier::startNewDrive() {
  startNewSeries();
  regression_.restart();
  excitation_.restart();
  takeExcitation();
}

void StrutIdentifier::setForgetting(const MonitorSettings& options) {
  const double slow = options.forgettingFactor(filter_.period);
  const std::optional<double> fastest =
      options.fastest_memory ? std::optional(options.fastestForgettingFactor(filter_.period)) : std::nullopt;
  estimators_.setForgetting(slow, fastest);
  regression_.setForgettingFactor(slow);
  errors_.setForgettingFactor(slow);
  fewest_rows_ = options.fewestRows(kFewestHorizons, filter_.period);
}

}  // namespace suspension_health_monitor
