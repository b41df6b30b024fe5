#pragma once

#include <string>

#include "suspension_health_monitor/internal/health/drive_change.h"

namespace suspension_health_monitor {

/// How a strut is against another drive: by how much, and where on the curves.
/// @param other  name of that drive.
/// @return e.g. "damping 23 % below march.bag (90 %: 20 to 26 %), softer in rebound above 0.3 m/s; stiffness within -1
/// to +2 %", or "no certain change against march.bag: damping within -4 to +3 %; stiffness within -1 to +2 %"; empty if
/// neither b1 nor b0 can be compared.
std::string describe(const DriveChange& change, const std::string& other);

/// @param stddev  of ln(1 + change).  @param beyond  probability on either side.
/// @return what holds the size of a change: "28 to 34 %", "2 % below to 4 % above"; empty: not known, or no wider than
/// the last digit.
std::string intervalOf(double change, double stddev, double beyond = 0.025);

}  // namespace suspension_health_monitor
