#pragma once

#include <string>

#include "suspension_health_monitor/internal/health/drive_change.h"

namespace suspension_health_monitor {

/// How a strut is against another drive: by how much, and where on the curves.
/// @param other  name of that drive.
/// @return e.g. "damping 23 % below march.bag (90 %: 20 to 26 %), softer in rebound above 0.3 m/s; stiffness within
/// -0.8 to +1.2 %", or "no certain change against march.bag: damping within -4 to +3 %; stiffness within
/// -0.8 to +1.2 %"; empty if neither b1 nor b0 can be compared.
std::string describe(const DriveChange& change, const std::string& other);

}  // namespace suspension_health_monitor
