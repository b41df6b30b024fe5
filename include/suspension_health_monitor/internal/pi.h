#pragma once

namespace suspension_health_monitor {

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace suspension_health_monitor
