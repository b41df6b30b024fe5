#include "suspension_health_monitor/internal/vehicle/coupling_survey.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kShortestHorizon = 0.1, kLongestHorizon = 0.8;  // [s]
constexpr int kFewestSamples = 8;                                // of a horizon

// @return the largest rms that the ratios' difference gives a strut's own acceleration, as a share of it, beyond what
// their standard deviations account for; 0 where one has an anti-roll bar that the other has not: they are two models.
double unexplainedDifference(const CouplingEstimate& a, const CouplingEstimate& b) {
  if (a.bars() != b.bars()) return 0.0;
  const StrutVector& power = a.coupling.own_power;
  double most = 0.0;
  for (Eigen::Index i = 0; i < power.size(); ++i) {
    double beyond = 0.0;
    for (Eigen::Index j = 0; j < power.size(); ++j)
      beyond += (square(a.coupling.ratios(i, j) - b.coupling.ratios(i, j)) - square(a.stddevs(i, j)) -
                 square(b.stddevs(i, j))) *
                power[j] / power[i];
    most = std::max(most, beyond);
  }
  return std::sqrt(most);
}

}  // namespace

CouplingSurvey::CouplingSurvey(const CouplingColumns& columns, double period, double memory, const SensorNoise& noise)
    : best_(columns) {
  for (double horizon = kShortestHorizon; horizon <= kLongestHorizon; horizon *= 2.0) {
    IntegralFilterOptions filter;
    filter.period = period;
    filter.horizon_samples = static_cast<int>(std::lround(horizon / period));
    if (filter.horizon_samples >= kFewestSamples) estimators_.emplace_back(columns, filter, memory / period, noise);
  }
  if (estimators_.empty())
    throw std::invalid_argument("sample_period = " + numberText(period) + " [s], must be at most " +
                                numberText(kLongestHorizon / kFewestSamples) + " for the struts of a vehicle");
}

void CouplingSurvey::setNoise(const SensorNoise& noise) {
  for (CouplingEstimator& estimator : estimators_) estimator.setNoise(noise);
}

void CouplingSurvey::add(const VehicleSample& sample) {
  for (CouplingEstimator& estimator : estimators_) estimator.add(sample);
}

void CouplingSurvey::startNewSeries() {
  for (CouplingEstimator& estimator : estimators_) estimator.startNewSeries();
}

const CouplingEstimate& CouplingSurvey::solve() {
  for (CouplingEstimator& estimator : estimators_) estimator.solve();
  const CouplingEstimate* best = &estimators_.front().estimate();
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < estimators_.size(); ++i) {
    const CouplingEstimate& estimate = estimators_[i].estimate();
    const bool has_longer = i + 1 < estimators_.size() && estimators_[i + 1].estimate().doubt < HUGE_VAL;
    const double doubt =
        estimate.doubt + (has_longer ? unexplainedDifference(estimate, estimators_[i + 1].estimate()) : 0.0);
    if (!(doubt < least)) continue;
    least = doubt;
    best = &estimate;
  }
  best_ = *best;
  best_.doubt = least;
  return best_;
}

}  // namespace suspension_health_monitor
