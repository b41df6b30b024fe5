#include "suspension_health_monitor/internal/vehicle/coupling_estimator.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr int kRowsPerHorizon = 8;
// psi's noise is white within a horizon, but what the regressors make of theirs is not: the ratios scatter as if every
// other row counted (vehicle_table coupling: their mean square over the one expected).
constexpr double kRowsPerIndependent = 2.0;
constexpr double kFarRest = 3.0;  // usual ones: a row that is farther off is limited to it

// Samples from a row that is taken to the next.
int rowSpacing(const IntegralFilterOptions& filter) { return std::max(1, filter.horizon_samples / kRowsPerHorizon); }

}  // namespace

CouplingEstimator::CouplingEstimator(const CouplingColumns& columns, const IntegralFilterOptions& filter, double memory,
                                     const SensorNoise& noise)
    : columns_(columns),
      filter_(filter),
      rows_(columns, filter),
      row_due_(rowSpacing(filter)),
      forgetting_factor_(std::exp(-rowSpacing(filter) / memory)),
      mean_(CouplingRow::Zero(columns.size())),
      moments_(CouplingMoments::Zero(columns.size(), columns.size())),
      usual_rest_(forgetting_factor_),
      solver_(columns, momentsOfNoise(columns, filter, noise)) {}

void CouplingEstimator::add(const VehicleSample& sample) {
  const CouplingRow* row = rows_.push(sample);
  if (row == nullptr || !row_due_()) return;
  const double weight = weightOf(*row);
  weight_ = (estimate().isKnown() ? forgetting_factor_ : 1.0) * weight_ + weight;
  mean_ += weight / weight_ * (*row - mean_);
  moments_ += weight / weight_ * (*row * row->transpose() - moments_);
}

// Rows whose rest is larger than usual count less, as those of lost readings.
double CouplingEstimator::weightOf(const CouplingRow& row) {
  if (!solver_.hasStart()) return 1.0;
  const CouplingEstimate& estimate = solver_.estimate();
  const int n = columns_.struts;
  StrutVector own(n);
  for (int j = 0; j < n; ++j) own[j] = ownColumns(estimate, j).dot(row.head(columns_.numOwn()));
  const StrutVector rest = row.tail(n) - estimate.coupling.ratios * own -
                           estimate.coupling.forces * row.segment(columns_.numOwn(), columns_.forces);
  const double size = rest.norm();
  usual_rest_.add(size);
  return std::min(1.0, kFarRest * usual_rest_.mean() / size);
}

const CouplingEstimate& CouplingEstimator::solve() {
  if (weight_ <= 0.0) return estimate();
  return solver_.solve(moments_ - mean_ * mean_.transpose(), weight_ / kRowsPerIndependent);
}

}  // namespace suspension_health_monitor
