#include <cmath>

#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"

namespace suspension_health_monitor {
namespace {

std::optional<PredictionError> errorOf(const std::vector<double>& measured, const std::vector<double>& predicted) {
  using Series = Eigen::Map<const Eigen::ArrayXd>;
  if (measured.empty()) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(measured.size());
  const Series y(measured.data(), count);
  const double error = (y - Series(predicted.data(), count)).square().sum(), spread = (y - y.mean()).square().sum();
  if (!(spread > 0.0) || !std::isfinite(error)) return std::nullopt;
  return PredictionError{std::sqrt(error / static_cast<double>(count)), 100.0 * (1.0 - std::sqrt(error / spread))};
}

/// The measurement without the faults of its reading, to first order in them.
std::vector<double> trueReading(const ComparedSegment& segment, const StrutModel& model) {
  std::vector<double> faulty = segment.measured;
  for (const ActiveMeasurementEffect& reading : model.reading)
    reading.effect.apply(reading.coefficients.data(), segment.body, segment.period, faulty);
  for (std::size_t k = 0; k < faulty.size(); ++k) faulty[k] = 2.0 * segment.measured[k] - faulty[k];
  return faulty;
}

}  // namespace

std::optional<PredictionError> freeRunError(const std::vector<ComparedSegment>& segments) {
  std::vector<double> measured, predicted;
  for (const ComparedSegment& segment : segments) {
    measured.insert(measured.end(), segment.measured.begin(), segment.measured.end());
    predicted.insert(predicted.end(), segment.predicted.begin(), segment.predicted.end());
  }
  return errorOf(measured, predicted);
}

std::optional<PredictionError> oneStepError(const std::vector<ComparedSegment>& segments, const StrutModel& model,
                                            const IntegralFilterOptions& filter) {
  std::vector<double> measured, predicted;
  for (const ComparedSegment& segment : segments) {
    SuspensionRegression regression(filter);
    LinearIntegralFilter added(2, filter, 2);
    const std::vector<double> reading = trueReading(segment, model);
    for (std::size_t k = 0; k < segment.size(); ++k) {
      added.push(segment.added_force[k]);
      const RegressionRow* row = regression.push({{}, reading[k], segment.wheel[k]});
      if (row == nullptr) continue;
      measured.push_back(row->output);
      predicted.push_back(model.damping_to_mass * row->regressor[kDampingToMass] +
                          model.stiffness_to_mass * row->regressor[kStiffnessToMass] + added.output(2));
    }
  }
  return errorOf(measured, predicted);
}

}  // namespace suspension_health_monitor
