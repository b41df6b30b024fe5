#include "suspension_health_monitor/suspension_monitor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

const MonitorOptions& checked(const MonitorOptions& options) {
  if (!options.sample_period) throw std::invalid_argument("sample_period is not given, must be above 0 [s]");
  options.validate();
  return options;
}

/// lambda with a memory 1 / (1 - lambda) of `seconds`.
double windowFactor(double seconds, double period) { return 1.0 - std::min(1.0, period / seconds); }

template <class Estimator>
void describeStrut(const Estimator& estimator, StrutEstimate& estimate) {
  estimate.damping_to_mass = estimator.parameters()[kDampingToMass];
  estimate.stiffness_to_mass = estimator.parameters()[kStiffnessToMass];
  estimate.damping_to_mass_stddev = std::sqrt(estimator.parameterVariance(kDampingToMass));
  estimate.stiffness_to_mass_stddev = std::sqrt(estimator.parameterVariance(kStiffnessToMass));
  estimate.effective_rows = estimator.effectiveRows();
  const double output = estimator.meanAbsoluteOutput();
  estimate.explained = output > 0.0 ? 1.0 - estimator.meanAbsoluteResidual() / output : 0.0;
}

}  // namespace

SuspensionMonitor::SuspensionMonitor(const MonitorOptions& options)
    : options_(checked(options)),
      period_(fromSeconds(*options.sample_period)),
      horizon_samples_(options.horizonSamples(*options.sample_period)),
      min_rows_(std::min<double>(options.valid_min_rows, 0.9 / (1.0 - std::min(options.forgetting_factor, 1 - 1e-12)))),
      regression_(options.filter(*options.sample_period)),
      least_squares_(kNumStrutParameters, options.recursive()),
      least_absolute_(kNumStrutParameters, options.recursive(), options.leastAbsolute()),
      free_run_(*options.sample_period),
      comparison_(windowFactor(options.comparison_window, *options.sample_period)),
      health_(options.health()),
      spacing_(windowFactor(options.comparison_window, *options.sample_period)) {}

const MonitorReport* SuspensionMonitor::addSample(const CornerSample& sample) {
  if (!isUsable(sample.sprung_acceleration) || !isUsable(sample.unsprung_acceleration)) {
    rejected_.add(RejectReason::kNotFinite);
    return nullptr;
  }
  if (!continues(sample.stamp)) return nullptr;
  last_stamp_ = sample.stamp;
  report_.stamp = sample.stamp;
  ++input_.samples;
  const RegressionRow* row = regression_.push(sample);
  report_.has_row = row != nullptr;
  if (row != nullptr) estimate(*row);
  compare(sample);
  report_.health = health_.update(sample.stamp, report_.la);
  return &report_;
}

bool SuspensionMonitor::continues(Stamp stamp) {
  if (!last_stamp_) return true;
  const Stamp spacing = stamp - *last_stamp_;
  switch (continuity(spacing, period_)) {
    case Continuity::kTooSoon:
      rejected_.add(RejectReason::kTooSoon);
      return false;
    case Continuity::kContinues:
      spacing_.add(toSeconds(spacing));
      input_.mean_period = spacing_.mean();
      break;
    case Continuity::kGap:
      ++input_.gaps;
      startNewSeries();
      break;
    case Continuity::kClockJumped:
      ++input_.restarts;
      startNewSeries();
      break;
  }
  return true;
}

void SuspensionMonitor::startNewSeries() {
  regression_.reset();
  free_run_.reset();
  report_.ls.valid = false;
  report_.la.valid = false;
}

void SuspensionMonitor::estimate(const RegressionRow& row) {
  ++input_.rows;
  silent_rows_ = row.output == 0.0 ? std::min(silent_rows_ + 1, horizon_samples_) : 0;
  const bool moves = silent_rows_ < horizon_samples_;
  if (moves) {
    least_squares_.update(row);
    least_absolute_.update(row);
    describeStrut(least_squares_, report_.ls);
    describeStrut(least_absolute_, report_.la);
  }
  report_.ls.valid = moves && isValid(report_.ls);
  report_.la.valid = moves && isValid(report_.la);
}

bool SuspensionMonitor::isValid(const StrutEstimate& estimate) const {
  return estimate.effective_rows >= min_rows_ && estimate.explained >= options_.valid_min_explained &&
         estimate.damping_to_mass > 0.0 && estimate.stiffness_to_mass > 0.0;
}

void SuspensionMonitor::compare(const CornerSample& sample) {
  ComparisonReport& comparison = report_.comparison;
  const StrutEstimate& la = report_.la;
  if (la.valid) free_run_.trySetModel(la.damping_to_mass, la.stiffness_to_mass);
  comparison.measured = sample.sprung_acceleration;
  comparison.predicted = free_run_.push(sample.unsprung_acceleration);
  if (!free_run_.settled()) comparison.predicted.reset();
  if (!comparison.predicted) return;
  comparison_.add(comparison.measured, *comparison.predicted);
  comparison.rmse = comparison_.rmse();
  comparison.fit_percent = comparison_.fitPercent(comparison.rmse);
  // Parameters whose free run is worse than a constant are not those of this strut, however small the rows' residuals.
  if (comparison.fit_percent < 0.0 && comparison_.isFull()) report_.la.valid = false;
}

}  // namespace suspension_health_monitor
