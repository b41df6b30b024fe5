#include "suspension_health_monitor/internal/monitor/strut_identifier.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

// Normally LA's mean |residual| is the smaller one. After wrong readings LS's may be, for a few memories; if for
// longer, LA is lost: one absurd reading may send it further than its covariance lets it come back from. It then begins
// again from LS.
constexpr double kMostLost = 10.0;  // memories

RecursiveOptions recursiveOf(const MonitorSettings& options, int horizon_samples) {
  RecursiveOptions recursive = options.recursive(2 * horizon_samples);
  recursive.drifting_offset = options.estimators.drifting_offset;
  return recursive;
}

// @param num_model  columns of the strut and of its effects, before those of the sensors.
template <class Estimator>
void writeParameters(const Estimator& estimator, int num_model, StrutEstimate& estimate) {
  if (!(estimator.effectiveRows() > 0.0)) return;  // the start values are no estimates
  const Eigen::VectorXd& theta = estimator.parameters();
  const auto stddev = [&](int i) { return std::sqrt(estimator.parameterVariance(i)); };
  estimate.damping_to_mass = theta[kDampingToMass];
  estimate.stiffness_to_mass = theta[kStiffnessToMass];
  estimate.damping_to_mass_stddev = stddev(kDampingToMass);
  estimate.stiffness_to_mass_stddev = stddev(kStiffnessToMass);
  estimate.correlation = std::nan("");
  estimate.num_effects = static_cast<std::size_t>(num_model - kNumStrutParameters);
  for (std::size_t j = 0; j < estimate.num_effects; ++j) {
    const int i = kNumStrutParameters + static_cast<int>(j);
    estimate.coefficients[j] = theta[i];
    estimate.coefficient_stddevs[j] = stddev(i);
  }
  if (num_model < estimator.numParameters()) estimate.offset = -theta[num_model] / theta[kStiffnessToMass];
  estimate.effective_rows = estimator.effectiveRows();
  estimate.explained = estimator.explained();
  const double mean_size = estimator.meanAbsoluteResidual();
  estimate.tails = mean_size > 0.0 ? estimator.meanSquareResidual() / (mean_size * mean_size) : 0.0;
}

}  // namespace

StrutIdentifier::StrutIdentifier(const MonitorSettings& options)
    : filter_(options.filter(*options.sample_period)),
      offset_columns_(options.estimators.drifting_offset ? 2 : 0),
      forgets_unexcited_(options.estimators.forgets_unexcited),
      regression_(filter_, 0, options.estimators.drifting_offset),
      least_squares_(kNumStrutParameters + offset_columns_, recursiveOf(options, filter_.horizon_samples)),
      least_absolute_(kNumStrutParameters + offset_columns_, recursiveOf(options, filter_.horizon_samples)),
      silent_rows_(filter_.horizon_samples),
      rows_(std::numeric_limits<double>::infinity()) {  // the plain columns are there from the first row on
  setForgetting(options);
}

void StrutIdentifier::changeEffects(const std::vector<ColumnOrigin>& effects) {
  std::vector<ColumnOrigin> columns{{kDampingToMass, 0.0}, {kStiffnessToMass, 0.0}};
  for (ColumnOrigin effect : effects) {
    if (effect.before) *effect.before += kNumStrutParameters;
    columns.push_back(effect);
  }
  for (int j = 0; j < offset_columns_; ++j) columns.push_back({numModelColumns() + j, 0.0});
  forEach([&](RecursiveEstimator& estimator) { estimator.changeColumns(columns); });
  regression_ = SuspensionRegression(filter_, effects.size(), offset_columns_ > 0);
  has_row_ = false;
  rows_ = 0.0;
}

void StrutIdentifier::add(const CornerSample& sample, const double* effect_forces) {
  const RegressionRow* row = regression_.push(sample, effect_forces);
  has_row_ = row != nullptr;
  if (!has_row_) return;
  silent_rows_.add(row->output);
  // Rows that LA hits exactly would weigh so much that it could not leave them for minutes.
  if (!silent_rows_.moves()) return;
  rows_ += 1.0;
  if (!holds_) return update(*row);
  forEach([&](RecursiveEstimator& estimator) { estimator.observe(*row); });
}

void StrutIdentifier::update(const RegressionRow& row) {
  least_squares_.update(row);
  least_absolute_.update(row);
  const bool is_lost = kClearlyMore * least_squares_.meanAbsoluteResidual() < least_absolute_.meanAbsoluteResidual();
  lost_memories_ = is_lost ? lost_memories_ + 1.0 - forgettingFactor() : 0.0;
  if (lost_memories_ > kMostLost) least_absolute_.beginAgain(least_squares_);
}

void StrutIdentifier::write(StrutEstimate& ls, StrutEstimate& la) const {
  writeParameters(least_squares_, numModelColumns(), ls);
  writeParameters(least_absolute_, numModelColumns(), la);
}

EstimateFacts StrutIdentifier::facts(const StrutEstimate& estimate, const EstimateFacts& of_input) const {
  EstimateFacts facts = of_input;
  facts.has_row = has_row_;
  facts.rows = std::min(estimate.effective_rows, rows_);
  facts.fewest_rows = fewest_rows_;
  facts.is_physical = estimate.damping_to_mass > 0.0 && estimate.stiffness_to_mass > 0.0;
  return facts;
}

void StrutIdentifier::startNewSeries() {
  regression_.reset();
  forEach([](RecursiveEstimator& estimator) { estimator.interrupt(); });
  has_row_ = false;
}

void StrutIdentifier::setForgetting(const MonitorSettings& options) {
  const double factor = options.forgettingFactor(filter_.period);
  forEach([&](RecursiveEstimator& estimator) { estimator.setForgettingFactor(factor); });
  fewest_rows_ = options.fewestRows(kFewestHorizons, filter_.period);
}

}  // namespace suspension_health_monitor
