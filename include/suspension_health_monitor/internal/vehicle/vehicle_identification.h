#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// @param names  of the struts.  @param forces  names of the known forces.
/// @return what is known of a vehicle at the end of recorded drives. Looks for the body anew.
VehicleIdentification identified(VehicleMonitor& monitor, const std::vector<std::string>& names,
                                 const std::vector<std::string>& forces);

/// @return how the struts move one another, as it is known now.
VehicleCoupling couplingOf(const VehicleMonitor& monitor, const std::vector<std::string>& names,
                           const std::vector<std::string>& forces);

}  // namespace suspension_health_monitor
