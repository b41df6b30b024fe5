#pragma once

#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/drive.h"

namespace suspension_health_monitor {

/// @return true for an acceleration that can be computed with: not NaN, not infinite, nor so large that sums of its
/// fourth power would overflow.
inline bool isUsable(double acceleration) { return std::abs(acceleration) < 1e60; }

inline constexpr double kStandardGravity = 9.80665;  ///< standard [m/s^2]
/// Tolerance of a mean about 1, and, as a share, about gravity: offsets and an inclination of 30 degrees move it so
/// far.
inline constexpr double kGravityTolerance = 0.15;
inline constexpr double kLargestOffset = 0.8;  ///< of cheap accelerometers at most [m/s^2]

/// @return true if a sensor whose mean is that of gravity reads in g: no usual offset makes 1 of nothing.
inline bool readsInG(double mean) { return std::abs(mean - 1.0) < kGravityTolerance; }

/// @return the number of a strut's stream where streams are numbered.
constexpr std::size_t indexOf(Side side) { return static_cast<std::size_t>(side); }

}  // namespace suspension_health_monitor
