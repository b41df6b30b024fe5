#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_inertia.h"
#include "suspension_health_monitor/internal/vehicle/coupling_estimator.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// @return why the coupling is not known, to be read after "the drives"; empty if it is.
std::string reasonOf(const CouplingEstimate& estimate, const std::vector<std::string>& struts);

/// @return why it is not known how the body's mass is spread, in a sentence; empty if it is.
std::string describe(InertiaDoubt doubt);

/// @return the verdict in a sentence.
std::string summaryOf(const VehicleDiagnosis& diagnosis, const std::vector<std::string>& struts);

}  // namespace suspension_health_monitor
