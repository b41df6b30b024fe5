#pragma once

#include <string>

#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

namespace suspension_health_monitor {

/// Reads which sensors a vehicle has, and where (vehicle/vehicle_layout.h).
/// @throws std::invalid_argument  naming the file and what is wrong in it.
VehicleLayout readVehicleFile(const std::string& path);

}  // namespace suspension_health_monitor
