#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {

inline SimulationOptions scenario(const std::string& name, double duration = 120.0) {
  SimulationOptions options;
  options.scenario = name;
  options.duration = duration;
  return options;
}

inline std::vector<DriveSample> drive(const SimulationOptions& options) {
  DriveSimulator simulator(options);
  std::vector<DriveSample> samples;
  while (std::optional<DriveSample> sample = simulator.next()) samples.push_back(*sample);
  return samples;
}

inline double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// @return the upper one of two in the middle.
inline double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

inline double standardDeviationOf(const std::vector<double>& values) {
  const double mean = meanOf(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace suspension_health_monitor
