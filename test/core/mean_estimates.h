#pragma once

#include <optional>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"
#include "uniform_grid.h"

namespace suspension_health_monitor {

inline constexpr double kAlignedPeriod = 0.005;  ///< [s] of the grid that the readings are brought onto

/// Means over a drive from 20 s on, when the estimates have settled.
struct MeanEstimates {
  double damping = 0.0, stiffness = 0.0, la_damping = 0.0, la_stiffness = 0.0, ls_damping = 0.0, ls_stiffness = 0.0;
  double stiffness_stddev = 0.0;  ///< that of the estimate
  double valid = 0.0;             ///< share of the samples, likewise
  bool resampled = false;
};

/// Identifies a strut by the readings of sensors as they come, gravity included.
inline MeanEstimates identify(const SimulationOptions& drive, Alignment alignment) {
  constexpr double kSettled = 20.0, kGravity = 9.81;  // [s], [m/s^2]
  MonitorSettings options;
  options.sample_period = kAlignedPeriod;
  options.forgetting_factor = 0.999;
  SuspensionMonitor monitor(options);
  UniformGrid grid(kAlignedPeriod, {alignment, 2 * monitor.horizonSamples()});
  DriveSimulator simulator(drive);
  MeanEstimates mean;
  double count = 0.0;
  const auto push = [&](Side side, const std::optional<AccelerometerReading>& reading) {
    if (!reading) return;
    const double measured = reading->acceleration + kGravity;
    auto sample = grid.push(side, reading->stamp, measured);
    if (grid.gate(side).taken()) monitor.addReading(side, *grid.gate(side).taken(), measured);
    for (; sample; sample = grid.next()) {
      const MonitorReport* report = monitor.addGridSample(*sample);
      if (report == nullptr || toSeconds(sample->stamp) < kSettled) continue;
      mean.damping += report->estimate.damping_to_mass;
      mean.stiffness += report->estimate.stiffness_to_mass;
      mean.la_damping += report->la.damping_to_mass;
      mean.la_stiffness += report->la.stiffness_to_mass;
      mean.ls_damping += report->ls.damping_to_mass;
      mean.ls_stiffness += report->ls.stiffness_to_mass;
      mean.stiffness_stddev += report->estimate.stiffness_to_mass_stddev;
      mean.valid += report->estimate.valid() ? 1.0 : 0.0;
      count += 1.0;
    }
  };
  while (const std::optional<DriveSample> sample = simulator.next()) {
    push(Side::kSprung, sample->sprung);
    push(Side::kUnsprung, sample->unsprung);
  }
  for (double* value : {&mean.damping, &mean.stiffness, &mean.la_damping, &mean.la_stiffness, &mean.ls_damping,
                        &mean.ls_stiffness, &mean.stiffness_stddev, &mean.valid})
    *value /= count;
  mean.resampled = grid.streams().resamples();
  return mean;
}

}  // namespace suspension_health_monitor
