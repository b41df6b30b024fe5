#include "suspension_health_monitor/internal/identification/paired_estimators.h"

#include <algorithm>

namespace suspension_health_monitor {
namespace {

// LA has the least mean absolute residual that there is, but for a few memories after wrong readings, which LS follows.
// Where LS has half of it for longer, LA is lost: one absurd reading may send it further than its covariance lets it
// come back from.
constexpr double kLost = 2.0;
constexpr double kMostLost = 10.0;  // memories

}  // namespace

PairedEstimators::PairedEstimators(SensorColumns sensors, const RecursiveOptions& recursive,
                                   const LeastAbsoluteOptions& least_absolute)
    : num_sensors_(count(sensors)),
      correlated_rows_(recursive.correlated_rows),
      least_squares_(kNumStrutParameters + num_sensors_, recursive),
      least_absolute_(kNumStrutParameters + num_sensors_, recursive, least_absolute) {}

std::vector<ColumnOrigin> PairedEstimators::changeEffects(const std::vector<ColumnOrigin>& effects) {
  std::vector<ColumnOrigin> columns{{kDampingToMass, 0.0}, {kStiffnessToMass, 0.0}};
  for (ColumnOrigin effect : effects) {
    if (effect.before) *effect.before += kNumStrutParameters;
    columns.push_back(effect);
  }
  for (int j = 0; j < num_sensors_; ++j) columns.push_back({numModelColumns() + j, 0.0});
  least_squares_.changeColumns(columns);
  least_absolute_.changeColumns(columns);
  if (variable_forgetting_) variable_forgetting_->restart(numModelColumns());
  return columns;
}

double PairedEstimators::update(const RegressionRow& row) {
  least_squares_.update(row);
  const double innovation = least_absolute_.update(row);
  const bool is_lost = kLost * least_squares_.meanAbsoluteResidual() < least_absolute_.meanAbsoluteResidual();
  lost_memories_ = is_lost ? lost_memories_ + 1.0 - forgettingFactor() : 0.0;
  if (lost_memories_ > kMostLost) least_absolute_.beginAgain(least_squares_);
  // An estimate that is not valid moves because it comes from its start; of a held one nobody knows whether it moves.
  if (variable_forgetting_ && la_is_valid_) {
    variable_forgetting_->add(row, innovation, least_absolute_.meanAbsoluteResidual());
    forgetBy(variable_forgetting_->factor());
  }
  return innovation;
}

void PairedEstimators::observe(const RegressionRow& row) {
  least_squares_.observe(row);
  least_absolute_.observe(row);
}

void PairedEstimators::hold(bool damping, bool stiffness) {
  const auto hold_of = [&](RecursiveEstimator& estimator) {
    estimator.hold(kDampingToMass, damping);
    estimator.hold(kStiffnessToMass, stiffness);
    for (int j = numModelColumns(); j < estimator.numParameters(); ++j) estimator.hold(j, damping || stiffness);
  };
  hold_of(least_squares_);
  hold_of(least_absolute_);
}

void PairedEstimators::interrupt() {
  least_squares_.interrupt();
  least_absolute_.interrupt();
}

void PairedEstimators::noteValidity(bool ls_is_valid, bool la_is_valid) {
  least_squares_.learnScatter(ls_is_valid && la_is_valid, least_absolute_.parameters());
  least_absolute_.learnScatter(la_is_valid, least_absolute_.parameters());
  if (variable_forgetting_ && la_is_valid_ && !la_is_valid) forgetBy(variable_forgetting_->slow());
  la_is_valid_ = la_is_valid;
}

void PairedEstimators::setForgetting(double slow, const std::optional<double>& fastest) {
  const double now = forgettingFactor();
  least_squares_.setForgettingFactor(slow);
  least_absolute_.setForgettingFactor(slow);
  if (!fastest) {
    variable_forgetting_.reset();
  } else if (!variable_forgetting_) {
    variable_forgetting_.emplace(numModelColumns(), correlated_rows_, slow, *fastest);
  } else {
    variable_forgetting_->setFactors(slow, *fastest);
    forgetBy(la_is_valid_ ? std::clamp(now, *fastest, slow) : slow);  // until it is decided anew
  }
}

double PairedEstimators::withoutEffects(const RegressionRow& row) const {
  double output = row.output;
  for (int j = kNumStrutParameters; j < numModelColumns(); ++j)
    output -= row.regressor[j] * least_absolute_.parameters()[j];
  return output;
}

void PairedEstimators::forgetBy(double factor) {
  least_squares_.setPresentFactor(factor);
  least_absolute_.setPresentFactor(factor);
}

}  // namespace suspension_health_monitor
