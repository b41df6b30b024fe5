#pragma once

#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/drive.h"

namespace suspension_health_monitor {

/// @return true for an acceleration that can be computed with: not NaN, not infinite, nor so large that sums of its
/// fourth power would overflow.
inline bool isUsable(double acceleration) { return std::abs(acceleration) < 1e60; }

inline constexpr double kStandardGravity = 9.80665;  ///< standard [m/s^2]
inline constexpr double kUsualOffset = 0.8;          ///< of cheap accelerometers at most [m/s^2]

/// @return the number of a strut's stream where streams are numbered.
constexpr std::size_t indexOf(Side side) { return static_cast<std::size_t>(side); }

}  // namespace suspension_health_monitor
