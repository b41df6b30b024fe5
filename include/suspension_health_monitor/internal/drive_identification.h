#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/monitor/vehicle_monitor.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// @param over_the_drive  the block estimate over all readings.  @param rejected  readings that were kept out.
/// @return what is known of a strut at the end of a recorded drive.
IdentifyResult identified(const SuspensionMonitor& monitor, const StrutEstimate& over_the_drive,
                          const RejectCounts& rejected);

/// @param names  of the struts.  @param forces  names of the known forces.
/// @return what is known of a vehicle at the end of recorded drives. Looks for the body anew.
VehicleIdentification identified(VehicleMonitor& monitor, const std::vector<std::string>& names,
                                 const std::vector<std::string>& forces);

/// @return what in the vehicle file is likely wrong, if a strut has no valid estimate now; else empty.
std::string describeMistake(const VehicleMonitor& monitor, const std::vector<std::string>& names);

/// @return how the struts move one another, as it is known now.
VehicleCoupling couplingOf(const VehicleMonitor& monitor, const std::vector<std::string>& names,
                           const std::vector<std::string>& forces);

}  // namespace suspension_health_monitor
