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

// Rows that an estimate needs before it is worth something, in horizons: noise of a tenth then makes an error of 1 or
// 2 %.
constexpr double kFewestHorizons = 5.0 / 3.0;

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
    : StrutIdentifier(options, options.filter(*options.sample_period), 0) {}

StrutIdentifier StrutIdentifier::ofWheel(MonitorSettings options) {
  options.estimators.drifting_offset = false;
  return {options, options.tyreFilter(*options.sample_period), 1};
}

StrutIdentifier::StrutIdentifier(const MonitorSettings& options, const IntegralFilterOptions& filter,
                                 int num_accelerations)
    : filter_(filter),
      offset_columns_(options.estimators.drifting_offset ? 2 : 0),
      forgets_unexcited_(options.forgets_unexcited),
      regression_(filter_, num_accelerations, offset_columns_ > 0, 0),
      least_squares_(kNumStrutParameters + num_accelerations + offset_columns_,
                     options.recursive(2 * filter.horizon_samples)),
      least_absolute_(least_squares_.numParameters(), options.recursive(2 * filter.horizon_samples)),
      rows_(std::numeric_limits<double>::infinity()) {  // these columns are there from the first row on
  setForgetting(options);
}

void StrutIdentifier::changeModel(std::vector<ColumnOrigin> columns) {
  regression_ = SuspensionRegression(filter_, columns.size() - kNumStrutParameters, offset_columns_ > 0);
  for (int j = 0; j < offset_columns_; ++j) columns.push_back({numModelColumns() + j, 0.0});
  forEach([&](RecursiveLeastSquares& estimator) { estimator.changeColumns(columns); });
  has_row_ = false;
  rows_ = 0.0;
}

void StrutIdentifier::add(const CornerSample& sample, const double* effect_forces) {
  const RegressionRow* row = regression_.push(sample, effect_forces);
  has_row_ = row != nullptr;
  if (!has_row_) return;
  silent_rows_ = row->output == 0.0 ? std::min(silent_rows_ + 1, filter_.horizon_samples) : 0;
  // Rows that LA hits exactly would weigh so much that it could not leave them for minutes.
  if (!moves()) return;
  rows_ += 1.0;
  if (!holds_) return update(*row);
  forEach([&](RecursiveLeastSquares& estimator) { estimator.observe(*row); });
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
  forEach([](RecursiveLeastSquares& estimator) { estimator.interrupt(); });
  has_row_ = false;
}

void StrutIdentifier::setForgetting(const MonitorSettings& options) {
  const double factor = options.forgettingFactor(filter_.period);
  forEach([&](RecursiveLeastSquares& estimator) { estimator.setForgettingFactor(factor); });
  fewest_rows_ = options.fewestRows(kFewestHorizons, filter_.period);
}

}  // namespace suspension_health_monitor
