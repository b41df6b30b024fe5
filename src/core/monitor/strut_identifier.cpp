#include "suspension_health_monitor/internal/monitor/strut_identifier.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr int kStddevsEvery = 8;  // rows
// LA has the least mean absolute residual that there is, but for a few memories after wrong readings, which LS follows.
// Where LS has half of it for longer, LA is lost: one absurd reading may send it further than its covariance lets it
// come back from.
constexpr double kLost = 2.0;
constexpr double kMostLost = 10.0;         // memories
constexpr double kMostNoise = 0.8;         // of a residual: no level of noise is known better than within a tenth
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

// What LS and LA differ by beyond the scatter of LS is an error of LS, which suffers wrong readings for as long as it
// remembers them, and whose own scatter does not show that they were all of one sign.
double withDifference(double stddev, double ls, double la) {
  return std::hypot(stddev, std::max(0.0, std::abs(ls - la) - stddev));
}

}  // namespace

StrutIdentifier::StrutIdentifier(const MonitorSettings& options)
    : filter_(options.filter(*options.sample_period)),
      sensors_(options.estimators.sensors),
      excitation_(filter_.horizon_samples, options.forgettingFactor(filter_.period), regressorNoise(options, filter_)),
      regression_(filter_, sensors_, excitation_.noise(), options.forgettingFactor(filter_.period)),
      least_squares_(kNumStrutParameters + count(sensors_), recursiveOf(options, filter_.horizon_samples)),
      least_absolute_(kNumStrutParameters + count(sensors_), recursiveOf(options, filter_.horizon_samples),
                      options.leastAbsolute()),
      forgetting_{!options.estimators.forgets_unexcited, {}},
      past_{present(), present()},
      stamp_noise_(filter_.period, options.forgettingFactor(filter_.period)),
      stddevs_due_(kStddevsEvery),
      skew_effect_(options.forgettingFactor(filter_.period)),
      silent_rows_(filter_.horizon_samples) {
  if (options.estimators.removes_noise_shift) noise_level_.emplace(filter_);
  noise_shift_ = Eigen::VectorXd::Zero(least_squares_.numParameters());
  rows_ = std::numeric_limits<double>::infinity();  // the plain columns are there from the first row on
  setForgetting(options);
}

void StrutIdentifier::changeEffects(const std::vector<ColumnOrigin>& effects) {
  std::vector<ColumnOrigin> columns{{kDampingToMass, 0.0}, {kStiffnessToMass, 0.0}};
  for (ColumnOrigin effect : effects) {
    if (effect.before) *effect.before += kNumStrutParameters;
    columns.push_back(effect);
  }
  for (int j = 0; j < count(sensors_); ++j) columns.push_back({numModelColumns() + j, 0.0});
  least_squares_.changeColumns(columns);
  least_absolute_.changeColumns(columns);
  past_.fill(present());
  regression_.changeEffects(effects.size());
  const Eigen::VectorXd before = noise_shift_;
  noise_shift_ = Eigen::VectorXd::Zero(least_squares_.numParameters());
  for (std::size_t j = 0; j < columns.size(); ++j)
    if (columns[j].before) noise_shift_[static_cast<Eigen::Index>(j)] = before[*columns[j].before];
  if (forgetting_.variable) forgetting_.variable->restart(numModelColumns());
  takeExcitation();
  has_row_ = false;
  rows_ = 0.0;
  stddevs_due_.restart();
}

void StrutIdentifier::add(const CornerSample& sample, const double* effect_forces) {
  stamp_noise_.add(sample);
  const RegressionRow* row = regression_.push(sample, effect_forces);
  has_row_ = row != nullptr;
  if (!has_row_) return;
  silent_rows_.add(row->output);
  // Rows that LA hits exactly would weigh so much that it could not leave them for minutes.
  if (!silent_rows_.moves()) return;
  rows_ += 1.0;
  const double output = withoutEffects(*row);
  if (excitation_.add(*row, output, regression_.wheel().output)) closeBlock();
  if (!holdsAll()) regression_.learnSkew(output);
  // Rows of a skew that nobody knows would bring the estimates where they had to come back from.
  if (regression_.skew() == nullptr || regression_.skew()->isKnown()) update(*row);
}

// The offset between the sensors is no part of psi, but of the regressor of the stiffness, which Excitation knows.
double StrutIdentifier::withoutEffects(const RegressionRow& row) const {
  double output = row.output;
  for (int j = kNumStrutParameters; j < numModelColumns(); ++j)
    output -= row.regressor[j] * least_absolute_.parameters()[j];
  return output;
}

bool StrutIdentifier::holdsAll() const {
  const bool excited = excitation_.excited(kDampingToMass) || excitation_.excited(kStiffnessToMass);
  return forgetting_.only_excited && (!excited || (excitation_.outsideForce() && excitation_.knowsStrut()));
}

void StrutIdentifier::update(const RegressionRow& row) {
  if (holdsAll()) {
    least_squares_.observe(row);
    least_absolute_.observe(row);
    return;
  }
  rows_to_forget_ = std::max(0.0, rows_to_forget_ - 1.0);
  if (regression_.skew() != nullptr) noteSkew(row);
  least_squares_.update(row);
  const double innovation = least_absolute_.update(row);
  if (hears_noise_ && noise_level_) noise_level_->add(innovation);
  const bool is_lost = kLost * least_squares_.meanAbsoluteResidual() < least_absolute_.meanAbsoluteResidual();
  lost_memories_ = is_lost ? lost_memories_ + 1.0 - forgettingFactor() : 0.0;
  if (lost_memories_ > kMostLost) least_absolute_.beginAgain(least_squares_);
  // An estimate that is not valid moves because it comes from its start; of a held one nobody knows whether it moves.
  if (!forgetting_.variable || !la_is_valid_) return;
  forgetting_.variable->add(row, innovation, least_absolute_.meanAbsoluteResidual());
  forgetBy(forgetting_.variable->factor());
}

void StrutIdentifier::noteSkew(const RegressionRow& row) {
  const WheelRow& wheel = regression_.wheel();
  const Eigen::VectorXd& strut = least_absolute_.parameters();
  const double x = strut[kDampingToMass] * wheel.output + strut[kStiffnessToMass] * wheel.damping;
  skew_effect_.add(
      {x * row.regressor[kDampingToMass], x * row.regressor[kStiffnessToMass], regression_.skew()->skew()});
}

// That two blocks of rows tell nothing of a parameter is known at their end, when their noise has pulled it already: so
// the estimates go back to before them.
void StrutIdentifier::closeBlock() {
  const auto num_held = [&] { return int{isHeld(kDampingToMass)} + int{isHeld(kStiffnessToMass)}; };
  const int before = num_held();
  takeExcitation();
  if (num_held() > before) {
    least_squares_.goBackTo(past_[0].ls);
    least_absolute_.goBackTo(past_[0].la);
    past_[1] = past_[0];
    return;
  }
  std::swap(past_[0], past_[1]);
  least_squares_.copyTo(past_[1].ls);
  least_absolute_.copyTo(past_[1].la);
}

void StrutIdentifier::takeExcitation() {
  if (excitation_.outsideForce()) rows_to_forget_ = kMemoriesToForget * least_absolute_.effectiveRows();
  const bool any = isHeld(kDampingToMass) || isHeld(kStiffnessToMass);
  for (RecursiveEstimator* estimator :
       {static_cast<RecursiveEstimator*>(&least_squares_), static_cast<RecursiveEstimator*>(&least_absolute_)}) {
    for (const StrutParameter i : {kDampingToMass, kStiffnessToMass}) estimator->hold(i, isHeld(i));
    for (int j = numModelColumns(); j < estimator->numParameters(); ++j) estimator->hold(j, any);
  }
}

void StrutIdentifier::noteValidity(const StrutEstimate& ls, const StrutEstimate& la) {
  least_squares_.learnScatter(ls.valid() && la.valid(), least_absolute_.parameters());
  least_absolute_.learnScatter(la.valid(), least_absolute_.parameters());
  if (la.valid()) excitation_.know({la.damping_to_mass, la.stiffness_to_mass});
  if (forgetting_.variable && la_is_valid_ && !la.valid()) forgetBy(forgetting_.variable->slow());
  la_is_valid_ = la.valid();
  // Noise that is as large as the motion is to be known before an estimate can be valid.
  hears_noise_ = la.valid() || (excitation_.noise().isOfVehicle() && la.doubt == EstimateDoubt::kNotExplained);
}

void StrutIdentifier::describe(StrutEstimate& ls, StrutEstimate& la) {
  describeParameters(least_squares_, noise_shift_, numModelColumns(), ls);
  describeParameters(least_absolute_, noise_shift_, numModelColumns(), la);
  for (StrutEstimate* estimate : {&ls, &la}) {
    estimate->damping_excitation = excitation_.excitation(kDampingToMass);
    estimate->stiffness_excitation = excitation_.excitation(kStiffnessToMass);
    if (regression_.skew() != nullptr) estimate->clock_skew = regression_.skew()->skew();
  }
  if (holdsAll()) return;
  // Of the start values there is no error to tell, and the first estimate comes with its own.
  const bool is_due = stddevs_due_() || std::isnan(la.damping_to_mass_stddev);
  if (is_due && la.effective_rows > 0.0) describeStddevs(ls, la);
}

// The shift by the sensors' noise is taken off from the next description on, by the strut that it leaves now: the fixed
// point of that is the strut whose rows, less the noise's share of their moments, it solves. It is that of LS for both:
// of normal residuals LA has the same. What is left is what it is not taken off of, and that nobody knows how the noise
// is divided between the sensors.
void StrutIdentifier::describeStddevs(StrutEstimate& ls, StrutEstimate& la) {
  const RegressorNoise& noise = excitation_.noise();
  const Eigen::Vector2d strut(la.damping_to_mass, la.stiffness_to_mass);
  // For a normal distribution the variance is pi/2 times the mean size squared.
  const double size = least_absolute_.usualResidual(), left = 0.5 * kPi * size * size / noise.residualGain(strut);
  // Beside a parameter that is held P is not that of the rows.
  const bool knows_rows = !isHeld(kDampingToMass) && !isHeld(kStiffnessToMass);
  const double fitted = noise_level_ && knows_rows ? fittedNoise(strut, left) : 1.0;
  const double present = fitted * left;
  const std::optional<double> lasting =
      noise_level_ ? noise_level_->sensorVariance(noise, strut, fitted) : std::nullopt;
  const double variance = std::min(lasting.value_or(present), present);
  noise_share_ = lasting ? variance / present : 0.0;
  const Eigen::Vector2d moment = noise.moment(strut, variance);
  const bool removes = lasting && knows_rows;
  if (removes) removeShift(moment);
  const Eigen::Vector2d spread = removes ? noise.momentSpread(strut, variance) : Eigen::Vector2d::Zero();
  // All of it or none, or a part: a uniform distribution from its end, which the estimate is at.
  const Eigen::Vector2d of_stamps = noise.momentOf(strut, stamp_noise_.variances()) / std::sqrt(3.0);
  const auto with_shift = [&](double random, int i) {
    const double not_removed = least_squares_.parameterShift(i, moment) - noise_shift_[i];
    const double of_noise =
        std::hypot(not_removed, least_squares_.parameterShift(i, spread), least_squares_.parameterShift(i, of_stamps));
    const double by_input = i < kNumStrutParameters ? input_stddevs_[i] : 0.0;
    return std::hypot(std::hypot(std::sqrt(random), of_noise), skewShift(i), by_input);
  };
  const auto of_ls = [&](int i) {
    return withDifference(with_shift(least_squares_.parameterVariance(i), i), least_squares_.parameters()[i],
                          least_absolute_.parameters()[i]);
  };
  const auto of_la = [&](int i) { return with_shift(least_absolute_.parameterVariance(i), i); };
  ls.damping_to_mass_stddev = of_ls(kDampingToMass);
  ls.stiffness_to_mass_stddev = of_ls(kStiffnessToMass);
  la.damping_to_mass_stddev = of_la(kDampingToMass);
  la.stiffness_to_mass_stddev = of_la(kStiffnessToMass);
  for (std::size_t j = 0; j < la.num_effects; ++j) {
    ls.coefficient_stddevs[j] = of_ls(kNumStrutParameters + static_cast<int>(j));
    la.coefficient_stddevs[j] = of_la(kNumStrutParameters + static_cast<int>(j));
  }
}

// What parameter i is off by if the skew is off by its standard deviation, and by what the rows of the memory, which
// were made with the skew as it was known then, differ by from it.
double StrutIdentifier::skewShift(int i) const {
  const SkewProfile* skew = regression_.skew();
  if (skew == nullptr) return 0.0;
  const Eigen::Vector2d moment(skew_effect_.mean(kOnDamping), skew_effect_.mean(kOnStiffness));
  const double off = std::hypot(std::sqrt(skew->variance()), skew->skew() - skew_effect_.mean(kTakenOff));
  return off * least_squares_.parameterShift(i, moment);
}

// Least squares fits the noise, too, which is missing from what it leaves: where g is the residual's variance by that
// of a sensor, v, and v m the noise's moment, it leaves g v - v^2 m'R^-1 m. @return v by what g alone would make of
// that.
double StrutIdentifier::fittedNoise(const Eigen::Vector2d& strut, double left) const {
  const Eigen::Vector2d moment = excitation_.noise().moment(strut, 1.0);
  const Eigen::Vector2d shift(least_squares_.parameterShift(kDampingToMass, moment),
                              least_squares_.parameterShift(kStiffnessToMass, moment));
  const double share = 4.0 * left * moment.dot(shift) / excitation_.noise().residualGain(strut);
  return 2.0 / (1.0 + std::sqrt(std::clamp(1.0 - share, 0.0, 1.0)));
}

// Noise does no more to a parameter that is excited than kLeastExcitation says.
void StrutIdentifier::removeShift(const Eigen::Vector2d& moment) {
  for (int i = 0; i < numModelColumns(); ++i) {
    const double most = std::abs(least_squares_.parameters()[i]) / Excitation::kLeastExcitation;
    noise_shift_[i] = std::clamp(least_squares_.parameterShift(i, moment), -most, most);
  }
}

// One gyro tells the tops of a vehicle's struts with more noise than they may have of motion: what is left of psi and
// of the residual without it.
double StrutIdentifier::explainedBesideNoise(const StrutEstimate& estimate) const {
  const RegressorNoise& noise = excitation_.noise();
  if (!noise.isOfVehicle()) return estimate.explained;
  const double share = std::min(noise_share_, kMostNoise), left = std::pow(1.0 - estimate.explained, 2);
  const Eigen::Vector2d strut(estimate.damping_to_mass, estimate.stiffness_to_mass);
  const double of_output = 1.0 - share * left * noise.outputGain() / noise.residualGain(strut);
  return of_output > 0.0 ? 1.0 - std::sqrt((1.0 - share) * left / of_output) : 0.0;
}

EstimateFacts StrutIdentifier::facts(const StrutEstimate& estimate) const {
  EstimateFacts facts;
  facts.has_row = has_row_;
  facts.sensor_moves = silent_rows_.moves();
  facts.rows = std::min(estimate.effective_rows, rows_);
  facts.fewest_rows = forgetting_.fewest_rows;
  facts.excites_damping = !isHeld(kDampingToMass);
  facts.excites_stiffness = !isHeld(kStiffnessToMass);
  facts.outside_force = rows_to_forget_ > 0.0;
  facts.explained = explainedBesideNoise(estimate);
  facts.is_physical = estimate.damping_to_mass > 0.0 && estimate.stiffness_to_mass > 0.0;
  facts.skew_is_known = regression_.skew() == nullptr || regression_.skew()->isWithin();
  facts.has_stddev = std::isfinite(estimate.damping_to_mass_stddev + estimate.stiffness_to_mass_stddev);
  return facts;
}

void StrutIdentifier::startNewSeries() {
  regression_.reset();
  least_squares_.interrupt();
  least_absolute_.interrupt();
  if (noise_level_) noise_level_->interrupt();
  stamp_noise_.interrupt();
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
  const double slow = options.forgettingFactor(filter_.period), now = forgettingFactor();
  const double fastest = options.fastestForgettingFactor(filter_.period);
  least_squares_.setForgettingFactor(slow);
  least_absolute_.setForgettingFactor(slow);
  regression_.setForgettingFactor(slow);
  skew_effect_.setForgettingFactor(slow);
  stamp_noise_.setForgettingFactor(slow);
  forgetting_.fewest_rows = options.fewestRows(kFewestHorizons, filter_.period);
  if (!options.fastest_memory) {
    forgetting_.variable.reset();
  } else if (!forgetting_.variable) {
    forgetting_.variable.emplace(numModelColumns(), 2 * filter_.horizon_samples, slow, fastest);
  } else {
    forgetting_.variable->setFactors(slow, fastest);
    forgetBy(la_is_valid_ ? std::clamp(now, fastest, slow) : slow);  // until it is decided anew
  }
}

void StrutIdentifier::forgetBy(double factor) {
  least_squares_.setPresentFactor(factor);
  least_absolute_.setPresentFactor(factor);
}

}  // namespace suspension_health_monitor
