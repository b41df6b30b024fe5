#include <cmath>

#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

/// Sums for both figures, without keeping the series.
class ErrorSums {
 public:
  void add(double measured, double predicted) {
    // Welford's sums: a large mean takes no digits.
    count_ += 1.0;
    const double before = measured - mean_;
    mean_ += before / count_;
    spread_ += before * (measured - mean_);
    error_ += square(measured - predicted);
  }

  std::optional<PredictionError> result() const {
    if (!(spread_ > 0.0) || !std::isfinite(error_)) return std::nullopt;
    return PredictionError{std::sqrt(error_ / count_), 100.0 * (1.0 - std::sqrt(error_ / spread_))};
  }

 private:
  double count_ = 0.0, mean_ = 0.0, spread_ = 0.0, error_ = 0.0;
};

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
  ErrorSums sums;
  for (const ComparedSegment& segment : segments)
    for (std::size_t k = 0; k < segment.size(); ++k) sums.add(segment.measured[k], segment.predicted[k]);
  return sums.result();
}

std::optional<PredictionError> oneStepError(const std::vector<ComparedSegment>& segments, const StrutModel& model,
                                            const IntegralFilterOptions& filter) {
  ErrorSums sums;
  for (const ComparedSegment& segment : segments) {
    SuspensionRegression regression(filter);
    LinearIntegralFilter added(2, filter, 2);
    const std::vector<double> reading = trueReading(segment, model);
    for (std::size_t k = 0; k < segment.size(); ++k) {
      added.push(segment.added_force[k]);
      const RegressionRow* row = regression.push({{}, reading[k], segment.wheel[k]});
      if (row == nullptr) continue;
      sums.add(row->output, model.damping_to_mass * row->regressor[kDampingToMass] +
                                model.stiffness_to_mass * row->regressor[kStiffnessToMass] + added.output(2));
    }
  }
  return sums.result();
}

}  // namespace suspension_health_monitor
