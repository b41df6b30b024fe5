#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "monitor_settings.h"
#include "simulated_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// The paper's experiment: 120 s at 50 Hz, damping falling from 3 to 2 1/s between 40 s and 100 s.
inline std::vector<DriveSample> paperExperiment(const std::string& scenario, int seed) {
  SimulationOptions options;
  options.scenario = scenario;
  options.seed = seed;
  return drive(options);
}

struct ParameterError {
  double damping_to_mass = 0.0;    ///< [1/s]
  double stiffness_to_mass = 0.0;  ///< [1/s^2]
};

struct EstimatorErrors {
  ParameterError ls, la;
};

/// rms difference between estimates and truth, row by row, once 10 s have passed.
inline EstimatorErrors rmsErrors(const std::vector<DriveSample>& drive, const MonitorSettings& options) {
  SuspensionMonitor monitor(options);
  EstimatorErrors sum;
  double count = 0.0;
  const auto addSquare = [](ParameterError& to, const StrutEstimate& estimate, const DriveTruth& truth) {
    to.damping_to_mass += std::pow(estimate.damping_to_mass - truth.damping_to_mass, 2);
    to.stiffness_to_mass += std::pow(estimate.stiffness_to_mass - truth.stiffness_to_mass, 2);
  };
  for (const DriveSample& sample : drive) {
    const MonitorReport& report =
        *monitor.addSample({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
    if (!report.has_row || sample.stamp <= std::chrono::seconds(10)) continue;
    addSquare(sum.ls, report.ls, sample.truth);
    addSquare(sum.la, report.la, sample.truth);
    ++count;
  }
  const auto root = [count](const ParameterError& of) -> ParameterError {
    return {std::sqrt(of.damping_to_mass / count), std::sqrt(of.stiffness_to_mass / count)};
  };
  return {root(sum.ls), root(sum.la)};
}

/// Median of every figure by itself.
inline EstimatorErrors medianOf(const std::vector<EstimatorErrors>& errors) {
  const auto median = [&](auto figure) {
    std::vector<double> values;
    for (const EstimatorErrors& error : errors) values.push_back(figure(error));
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return (values[(n - 1) / 2] + values[n / 2]) / 2;
  };
  return {{median([](const EstimatorErrors& e) { return e.ls.damping_to_mass; }),
           median([](const EstimatorErrors& e) { return e.ls.stiffness_to_mass; })},
          {median([](const EstimatorErrors& e) { return e.la.damping_to_mass; }),
           median([](const EstimatorErrors& e) { return e.la.stiffness_to_mass; })}};
}

}  // namespace suspension_health_monitor
