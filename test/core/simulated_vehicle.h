#pragma once

#include <vector>

#include "suspension_health_monitor/internal/simulation/vehicle_simulator.h"

namespace suspension_health_monitor {

inline std::vector<VehicleInstant> driveVehicle(const Vehicle& vehicle, const VehicleDriveOptions& options) {
  VehicleSimulator simulator(vehicle, options);
  std::vector<VehicleInstant> samples;
  while (std::optional<VehicleInstant> sample = simulator.next()) samples.push_back(*sample);
  return samples;
}

inline VehicleDriveOptions vehicleDrive(double duration, double rate = 100.0) {
  VehicleDriveOptions options;
  options.duration = duration;
  options.rate = rate;
  return options;
}

}  // namespace suspension_health_monitor
