#include "suspension_health_monitor/internal/identification/paired_estimators.h"

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
  return columns;
}

void PairedEstimators::update(const RegressionRow& row) {
  least_squares_.update(row);
  least_absolute_.update(row);
  const bool is_lost = kLost * least_squares_.meanAbsoluteResidual() < least_absolute_.meanAbsoluteResidual();
  lost_memories_ = is_lost ? lost_memories_ + 1.0 - forgettingFactor() : 0.0;
  if (lost_memories_ > kMostLost) least_absolute_.beginAgain(least_squares_);
}

void PairedEstimators::observe(const RegressionRow& row) {
  least_squares_.observe(row);
  least_absolute_.observe(row);
}

void PairedEstimators::interrupt() {
  least_squares_.interrupt();
  least_absolute_.interrupt();
}

void PairedEstimators::setForgettingFactor(double forgetting_factor) {
  least_squares_.setForgettingFactor(forgetting_factor);
  least_absolute_.setForgettingFactor(forgetting_factor);
}

}  // namespace suspension_health_monitor
