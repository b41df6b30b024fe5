#pragma once

#include <vector>

#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/vehicle/coupling_estimator.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// @param drives  of one vehicle.
/// @return the coupling of its struts over all of them.
/// @throws std::invalid_argument  if the struts of a drive have not the same stamps.
CouplingEstimate coupleStruts(const std::vector<StrutDrives>& drives, const IntegralFilterOptions& filter);

/// Every strut of a recorded drive on its own, as Decoupler does it live, but forward and backward in time, so that
/// nothing is late and the neighbours' travel needs to be known to a fifth of the natural frequency only.
/// @param models  of the struts, as they are known.
/// @return drives of quarter cars, a little shorter at the ends of every series.
StrutDrives separateStruts(const StrutDrives& drive, double period, const Coupling& coupling,
                           const std::vector<StrutModel>& models);

}  // namespace suspension_health_monitor
