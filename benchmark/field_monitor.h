#pragma once

#include <optional>

#include "field_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// @param memory  [s]; left out: the default
/// @return settings with the true values as the nominal ones.
inline MonitorSettings settingsFor(const FieldDrive& drive, std::optional<double> memory = {}) {
  MonitorOptions options;
  options.sample_period = 1.0 / drive.rate;
  options.memory = memory;
  options.nominal_damping_to_mass = drive.vehicle.b1;
  options.nominal_stiffness_to_mass = drive.vehicle.b0;
  return options;
}

/// Calls look(time, report) for every sample of a drive, times in [s].
template <class Look>
void follow(const FieldDrive& drive, std::optional<double> memory, double seconds, const Look& look) {
  FieldSimulator simulator(drive);
  SuspensionMonitor monitor(settingsFor(drive, memory));
  while (simulator.time() < seconds)
    if (const MonitorReport* report = monitor.addSample(simulator.next())) look(simulator.time(), *report);
}

}  // namespace suspension_health_monitor
