#include "suspension_health_monitor/model_tracker.h"

#include <algorithm>
#include <limits>

#include "suspension_health_monitor/pi.h"

namespace suspension_health_monitor {
namespace {

// Standard deviations change slowly, and are the dear part of a description.
constexpr unsigned kSpreadEvery = 32;  // rows
// Of that many samples the first gives figures of the free run's errors, and two are looked at for a force from
// outside: steps of 7 and 9, since a wheel that hops in step with the looks would seem to stand.
constexpr unsigned kComparedEvery = 16, kLookAgain = 7;
constexpr double kMostCorrelation = 2.0;  // of LS's scores, against LA's
// Rows of a motion that was not the wheel's count for a seventh then.
constexpr double kMemoriesToForget = 2.0;

// Every row: inlined, and without a loop for the plain strut.
template <class Estimator>
[[gnu::always_inline]] inline void describeStrut(const Estimator& estimator, StrutEstimate& estimate) {
  const double* const theta = estimator.parameters().data();
  estimate.damping_to_mass = theta[kDampingToMass];
  estimate.stiffness_to_mass = theta[kStiffnessToMass];
  estimate.effective_rows = estimator.effectiveRows();
  estimate.num_effects = static_cast<std::size_t>(estimator.numParameters() - kNumStrutParameters);
  if (estimate.num_effects == 0) return;
  std::copy_n(theta + kNumStrutParameters, estimate.num_effects, estimate.coefficients.begin());
  // Columns of effects may be too large for an estimator; what comes of that is judged at once, not at the next turn.
  estimate.valid = estimate.valid && std::isfinite(estimate.damping_to_mass + estimate.stiffness_to_mass);
}

/// What is random, and what the sensors' noise in the regressors shifts.
/// @param variance  of parameter i, what is random of it.
template <class Estimator, class Variance>
void describeSpread(const Estimator& estimator, const Variance& variance, const Eigen::Vector2d& noise_moment,
                    StrutEstimate& estimate) {
  const auto stddev = [&](int i) {
    const double shift = estimator.parameterShift(i, noise_moment);
    return std::sqrt(variance(i) + shift * shift);
  };
  estimate.damping_to_mass_stddev = stddev(kDampingToMass);
  estimate.stiffness_to_mass_stddev = stddev(kStiffnessToMass);
  for (std::size_t j = 0; j < estimate.num_effects; ++j)
    estimate.coefficient_stddevs[j] = stddev(kNumStrutParameters + static_cast<int>(j));
}

void doubtBoth(ModelReport& report, EstimateDoubt doubt) {
  report.ls.valid = report.la.valid = false;
  report.ls.doubt = report.la.doubt = doubt;
}

std::vector<ColumnOrigin> origins(const std::vector<ActiveEffect>& before, const std::vector<ActiveEffect>& after) {
  std::vector<ColumnOrigin> columns{{kDampingToMass, 0.0}, {kStiffnessToMass, 0.0}};
  for (const ActiveEffect& active : after) {
    const auto same = std::find_if(before.begin(), before.end(), [&](const ActiveEffect& other) {
      return other.effect.name == active.effect.name && other.shapes == active.shapes;
    });
    ColumnOrigin column{std::nullopt, active.coefficient};
    if (same != before.end()) column.before = kNumStrutParameters + static_cast<int>(same - before.begin());
    columns.push_back(column);
  }
  return columns;
}

}  // namespace

ModelTracker::ModelTracker(const MonitorOptions& options)
    : filter_(options.filter(*options.sample_period)),
      valid_min_rows_(options.valid_min_rows),
      min_explained_(options.valid_min_explained),
      motion_(filter_.horizon_samples),
      rows_of_model_(std::numeric_limits<double>::infinity()),
      regression_(filter_),
      noise_(filter_),
      least_squares_(kNumStrutParameters, options.recursive(2 * filter_.horizon_samples)),
      least_absolute_(kNumStrutParameters, options.recursive(2 * filter_.horizon_samples), options.leastAbsolute()),
      free_run_(*options.sample_period),
      comparison_(1.0 - std::min(1.0, *options.sample_period / options.comparison_window)),
      outside_force_(memoryInLooks(options.forgetting_factor)) {
  if (options.forgetting_rule == "directional")
    excitation_.emplace(filter_.horizon_samples, options.forgetting_factor, noise_);
  setForgetting(options);
}

void ModelTracker::setEffects(const std::vector<ActiveEffect>& effects, ModelReport& report) {
  const std::vector<ColumnOrigin> columns = origins(this->effects(), effects);
  free_run_.setEffects(effects);  // may throw: first
  least_squares_.changeColumns(columns);
  least_absolute_.changeColumns(columns);
  regression_ = SuspensionRegression(filter_, effects.size());
  excitation_doubt_ = EstimateDoubt::kNone;  // columns are not held until they are judged anew
  restartVariableForgetting();
  rows_of_model_ = 0.0;
  has_been_valid_ = has_own_model_ = false;
  starts_.clear();
  for (std::size_t j = 0; j < effects.size(); ++j) {
    starts_.push_back(least_absolute_.parameters()[kNumStrutParameters + static_cast<Eigen::Index>(j)]);
    free_run_.setCoefficient(j, starts_[j]);
  }
  if (least_absolute_.effectiveRows() > 0.0) {
    describe(report);
    describeSpreads(report);
  }
  doubtBoth(report, EstimateDoubt::kFewRows);
}

void ModelTracker::add(const CornerSample& newest, double time, const CornerSample* compared, ModelReport& report) {
  const std::optional<double> predicted = free_run_.push(newest.unsprung_acceleration, time);
  const bool plain = effects().empty();
  if (!plain && free_run_.runaways() != runaways_) fallBack();
  // Without a model of the travel there are no columns.
  const CornerSample* of_row = plain ? &newest : predicted ? compared : nullptr;
  const RegressionRow* row = of_row != nullptr ? regression_.push(*of_row, free_run_.effectForces()) : nullptr;
  report.has_row = row != nullptr;
  if (row != nullptr) estimate(*row, report);
  if (report.la.valid && (spread_phase_ % kModelEvery == 0 || !has_own_model_)) takeModel(report.la);
  report.comparison.has_sample = compared != nullptr;
  if (compared != nullptr) compare(*compared, predicted, report);
}

void ModelTracker::estimate(const RegressionRow& row, ModelReport& report) {
  rows_of_model_ += 1.0;
  const bool moves = motion_.moves(row.output);
  if (moves) {
    if (excitation_ && spread_phase_ % Excitation::kJudgeEvery == 0 &&
        excitation_->judge(row, least_absolute_.parameters()))
      takeExcitation(report);
    if (special_rows_) {
      updateSpecially(row);
    } else {
      least_squares_.update(row);
      least_absolute_.update(row);
    }
    describe(report);
    const unsigned every = report.la.valid ? kSpreadEvery : kModelEvery;
    if (spread_phase_ % every == 0 && excitation_doubt_ != EstimateDoubt::kNotExcited) describeSpreads(report);
    spread_phase_ = (spread_phase_ + 1) % kSpreadEvery;
  }
  // At once at the start, and when a sensor sticks.
  if (!moves || spread_phase_ % kModelEvery == 0 || !(report.la.valid && report.ls.valid))
    judgeEstimates(moves, report);
}

void ModelTracker::judgeEstimates(bool moves, ModelReport& report) {
  // Every row: as long as it is above 0, no estimate is valid.
  if (rows_of_force_ > 0.0 && moves && excitation_doubt_ != EstimateDoubt::kNotExcited) rows_of_force_ -= 1.0;
  report.ls.explained = explained(least_squares_);
  report.la.explained = explained(least_absolute_);
  for (StrutEstimate* estimate : {&report.ls, &report.la}) {
    estimate->doubt = moves ? doubt(*estimate) : EstimateDoubt::kSensorStuck;
    estimate->valid = estimate->doubt == EstimateDoubt::kNone;
  }
  if (!report.la.valid) return;
  if (!has_been_valid_) {
    least_squares_.beginSpread();
    least_absolute_.beginSpread();
  }
  has_been_valid_ = true;
  // From the first valid estimate on there is something to hold.
  if (excitation_) excitation_->know({report.la.damping_to_mass, report.la.stiffness_to_mass});
}

void ModelTracker::takeExcitation(ModelReport& report) {
  for (StrutEstimate* estimate : {&report.ls, &report.la}) {
    estimate->damping_excitation = excitation_->excitation(kDampingToMass);
    estimate->stiffness_excitation = excitation_->excitation(kStiffnessToMass);
  }
  const bool damping = excitation_->excited(kDampingToMass), stiffness = excitation_->excited(kStiffnessToMass);
  const EstimateDoubt before = excitation_doubt_;
  excitation_doubt_ = damping && stiffness ? EstimateDoubt::kNone
                      : damping            ? EstimateDoubt::kStiffnessNotExcited
                      : stiffness          ? EstimateDoubt::kDampingNotExcited
                                           : EstimateDoubt::kNotExcited;
  if (excitation_doubt_ == before) return;
  noteExcitation();
  for (RecursiveEstimator* estimator :
       {static_cast<RecursiveEstimator*>(&least_squares_), static_cast<RecursiveEstimator*>(&least_absolute_)}) {
    estimator->interrupt();
    estimator->hold(kDampingToMass, !damping);
    estimator->hold(kStiffnessToMass, !stiffness);
  }
}

void ModelTracker::describe(ModelReport& report) const {
  describeStrut(least_squares_, report.ls);
  describeStrut(least_absolute_, report.la);
}

void ModelTracker::describeSpreads(ModelReport& report) const {
  // LA's residuals, which outliers hardly touch; for a normal distribution the variance is pi/2 times their mean
  // squared.
  const double size = least_absolute_.usualResidual();
  const Eigen::Vector2d strut(report.la.damping_to_mass, report.la.stiffness_to_mass);
  const Eigen::Vector2d moment = noise_.moment(strut, 0.5 * kPi * size * size);
  // The rows of one wrong reading are correlated as no others are; LS's scores remember them for minutes, LA's never
  // see them. So LS's count only as far as its residuals show that it still has such rows: squared, as they are large
  // in the regressors, too, and have made P small.
  const double tails = std::max(1.0, least_squares_.meanSquareResidual() / (0.5 * kPi * size * size));
  describeSpread(
      least_squares_,
      [&](int i) {
        return least_squares_.parameterVariance(i, kMostCorrelation * tails * tails * least_absolute_.correlation(i));
      },
      moment, report.ls);
  describeSpread(
      least_absolute_, [&](int i) { return least_absolute_.parameterVariance(i); }, moment, report.la);
}

void ModelTracker::setPeriodFits(bool fits, ModelReport& report) {
  period_fits_ = fits;
  if (!fits) doubtBoth(report, EstimateDoubt::kWrongPeriod);
}

EstimateDoubt ModelTracker::doubt(const StrutEstimate& estimate) const {
  if (!period_fits_) return EstimateDoubt::kWrongPeriod;
  if (std::min(estimate.effective_rows, rows_of_model_) < (has_been_valid_ ? min_rows_ : start_rows_))
    return EstimateDoubt::kFewRows;
  if (excitation_doubt_ != EstimateDoubt::kNone) return excitation_doubt_;
  if (rows_of_force_ > 0.0) return EstimateDoubt::kOutsideForce;
  if (!(estimate.explained >= min_explained_)) return EstimateDoubt::kNotExplained;
  if (!(estimate.damping_to_mass > 0.0 && estimate.stiffness_to_mass > 0.0)) return EstimateDoubt::kNotAStrut;
  if (!std::isfinite(estimate.damping_to_mass_stddev + estimate.stiffness_to_mass_stddev))
    return EstimateDoubt::kNoSpread;
  return EstimateDoubt::kNone;
}

void ModelTracker::takeModel(const StrutEstimate& la) {
  if (!free_run_.trySetModel(la.damping_to_mass, la.stiffness_to_mass)) return;
  has_own_model_ = true;
  for (std::size_t j = 0; j < la.num_effects; ++j) free_run_.setCoefficient(j, la.coefficients[j]);
}

void ModelTracker::lead(const StrutEstimate& plain) {
  if (has_own_model_ || !plain.valid || !free_run_.trySetModel(plain.damping_to_mass, plain.stiffness_to_mass)) return;
  for (std::size_t j = 0; j < starts_.size(); ++j) free_run_.setCoefficient(j, starts_[j]);
}

// The coefficients made the free run leave all bounds: on without them until the estimates have seen enough rows anew.
void ModelTracker::fallBack() {
  runaways_ = free_run_.runaways();
  rows_of_model_ = 0.0;
  has_been_valid_ = has_own_model_ = false;
  for (std::size_t j = 0; j < starts_.size(); ++j) free_run_.setCoefficient(j, starts_[j] = 0.0);
}

void ModelTracker::lookForOutsideForce(const CornerSample& sample, ModelReport& report) {
  outside_force_.look(sample, report.la.valid);
  if (!outside_force_.isSuspected() || excitation_doubt_ == EstimateDoubt::kNotExcited) return;
  // Before the first valid estimate there is nothing to spoil: until the next look.
  rows_of_force_ = has_been_valid_ ? kMemoriesToForget * least_absolute_.effectiveRows() : 2.0 * kModelEvery;
  if (report.la.valid) doubtBoth(report, EstimateDoubt::kOutsideForce);
}

void ModelTracker::compare(const CornerSample& sample, const std::optional<double>& predicted, ModelReport& report) {
  ComparisonReport& comparison = report.comparison;
  comparison.stamp = sample.stamp;
  comparison.measured = sample.sprung_acceleration;
  comparison.predicted = predicted;
  if (!free_run_.settled()) comparison.predicted.reset();
  const unsigned phase = compared_++ % kComparedEvery;
  if (phase == 0 || phase == kLookAgain) lookForOutsideForce(sample, report);
  if (!comparison.predicted) return;
  comparison_.add(comparison.measured, *comparison.predicted);
  if (phase == 0) {
    comparison.rmse = comparison.base_rmse = comparison_.rmse();
    comparison.fit_percent = comparison.base_fit_percent = comparison_.fitPercent(comparison.rmse);
  }
  // Parameters whose free run is worse than a constant are not those of this strut, however small the rows' residuals.
  if (comparison.fit_percent < 0.0 && comparison_.isFull() && report.la.valid) {
    report.la.valid = false;
    report.la.doubt = EstimateDoubt::kFreeRunFails;
  }
}

void ModelTracker::startNewSeries(ModelReport& report) {
  regression_.reset();
  least_squares_.interrupt();
  least_absolute_.interrupt();
  free_run_.reset();
  if (excitation_) excitation_->reset();
  report.comparison.predicted.reset();
  doubtBoth(report, EstimateDoubt::kNoRows);
}

void ModelTracker::startNewDrive(ModelReport& report) {
  if (excitation_) {
    excitation_->restart();
    takeExcitation(report);
  }
  startNewSeries(report);
}

}  // namespace suspension_health_monitor
