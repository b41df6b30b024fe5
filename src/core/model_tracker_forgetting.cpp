// How fast a ModelTracker forgets.
#include <algorithm>

#include "suspension_health_monitor/model_tracker.h"

namespace suspension_health_monitor {

void ModelTracker::setForgetting(const MonitorOptions& options) {
  const double slow = options.forgetting_factor, fastest = options.fastestForgetting(), now = forgettingFactor();
  least_squares_.setForgettingFactor(slow);
  least_absolute_.setForgettingFactor(slow);
  outside_force_.setMemory(memoryInLooks(slow));
  start_rows_ = fewestRows(valid_min_rows_, slow);
  min_rows_ = fewestRows(valid_min_rows_, fastest);
  if (!options.fastest_forgetting_factor) {
    variable_.reset();
  } else if (!variable_) {
    variable_.emplace(least_absolute_.numParameters(), 2 * filter_.horizon_samples, slow, fastest);
  } else {
    variable_->setFactors(slow, fastest);
    // Until it is decided anew.
    forgetBy(excitation_doubt_ == EstimateDoubt::kNone ? std::clamp(now, fastest, slow) : slow);
  }
  noteSpecialRows();
}

// For other columns.
void ModelTracker::restartVariableForgetting() {
  if (variable_) {
    variable_->restart(least_absolute_.numParameters());
    forgetBy(variable_->slow());
  }
  noteSpecialRows();
}

void ModelTracker::updateSpecially(const RegressionRow& row) {
  if (excitation_doubt_ == EstimateDoubt::kNotExcited) {
    least_squares_.observe(row);
    least_absolute_.observe(row);
    return;
  }
  least_squares_.update(row);
  const double innovation = least_absolute_.update(row);
  // Estimates that come from their start move.
  if (!variable_ || excitation_doubt_ != EstimateDoubt::kNone || !has_been_valid_) return;
  variable_->add(row, innovation, least_absolute_.meanAbsoluteResidual());
  if (spread_phase_ % VariableForgetting::kDecideEvery != 0) return;
  forgetBy(variable_->factor());
}

// Of a parameter that is held nobody knows whether it moves.
void ModelTracker::noteExcitation() {
  if (variable_ && excitation_doubt_ != EstimateDoubt::kNone) forgetBy(variable_->slow());
  noteSpecialRows();
}

void ModelTracker::forgetBy(double factor) {
  least_squares_.setPresentFactor(factor);
  least_absolute_.setPresentFactor(factor);
}

}  // namespace suspension_health_monitor
