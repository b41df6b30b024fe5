#pragma once

#include <vector>

#include "reference/batch_estimators.h"
#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/identification/regression.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {

// The paper's strut (section 4).
constexpr double kPaperB1 = 3.0;   // [1/s]
constexpr double kPaperB0 = 13.8;  // [1/s^2]

inline std::vector<CornerSample> simulate(const SimulationOptions& options) {
  DriveSimulator simulator(options);
  std::vector<CornerSample> samples;
  while (const auto sample = simulator.next())
    samples.push_back({sample->stamp, sample->sprung->acceleration, sample->unsprung->acceleration});
  return samples;
}

/// The paper's road and sampling, strut healthy throughout.
inline std::vector<CornerSample> healthyPaperDrive(double duration, double noise, int seed = 1) {
  SimulationOptions options;
  options.damping_end_fraction = 1.0;
  options.duration = duration;
  options.noise = noise;
  options.seed = seed;
  return simulate(options);
}

inline std::vector<RegressionRow> strutRows(const std::vector<CornerSample>& samples,
                                            const IntegralFilterOptions& options) {
  SuspensionRegression regression(options);
  std::vector<RegressionRow> rows;
  for (const CornerSample& sample : samples)
    if (const RegressionRow* row = regression.push(sample)) rows.push_back(*row);
  return rows;
}

inline RegressionRows stack(const std::vector<RegressionRow>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  RegressionRows stacked{Eigen::MatrixXd(n, rows.front().regressor.size()), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    stacked.regressors.row(i) = rows[static_cast<std::size_t>(i)].regressor.transpose();
    stacked.outputs[i] = rows[static_cast<std::size_t>(i)].output;
  }
  return stacked;
}

}  // namespace suspension_health_monitor
