#include "suspension_health_monitor/internal/vehicle/coupling_survey.h"

#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/internal/plain_text.h"

namespace suspension_health_monitor {
namespace {

constexpr double kShortestHorizon = 0.1, kLongestHorizon = 0.8;  // [s]
constexpr int kFewestSamples = 8;                                // of a horizon

}  // namespace

CouplingSurvey::CouplingSurvey(int num_struts, int num_forces, double period, double memory, const SensorNoise& noise) {
  for (double horizon = kShortestHorizon; horizon <= kLongestHorizon; horizon *= 2.0) {
    IntegralFilterOptions filter;
    filter.period = period;
    filter.horizon_samples = static_cast<int>(std::lround(horizon / period));
    if (filter.horizon_samples >= kFewestSamples)
      estimators_.emplace_back(num_struts, num_forces, filter, memory / period, noise);
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
  for (std::size_t i = 0; i < estimators_.size(); ++i)
    if (estimators_[i].solve().doubt < estimate().doubt) best_ = i;
  return estimate();
}

}  // namespace suspension_health_monitor
