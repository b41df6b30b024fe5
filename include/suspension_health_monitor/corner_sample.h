#pragma once

#include <chrono>
#include <cmath>

namespace suspension_health_monitor {

/// Measurement time: nanoseconds since the epoch of the clock that stamped the data. An integer, so that a stamp of
/// today keeps its last nanosecond (a double would round it to about 2e-7 s).
using Stamp = std::chrono::nanoseconds;

/// @return the stamp or interval in [s].
inline double toSeconds(Stamp stamp) { return std::chrono::duration<double>(stamp).count(); }

/// @param seconds  [s], finite and below 2.9e2 years in magnitude.
/// @return the nearest whole nanosecond.
inline Stamp fromSeconds(double seconds) { return std::chrono::round<Stamp>(std::chrono::duration<double>(seconds)); }

/// @return true for an acceleration that can be computed with: not NaN, not infinite, nor so large that sums of its
/// fourth power would overflow.
inline bool isUsable(double acceleration) { return std::abs(acceleration) < 1e60; }

/// What the two accelerometers of one strut read at one instant.
///
/// Signs and units of the whole library (z sprung position, w unsprung position, up positive as in REP 103):
///   travel d = w - z [m], compression positive; travel rate v = w' - z' [m/s];
///   sprung acceleration y = z'' [m/s^2]; relative acceleration u = w'' - z'' [m/s^2].
/// A constant common to both readings (gravity: an IMU at rest reads +9.81 on its up axis, REP 145) may stay in them:
/// it cancels in u, and the regression row of y holds second differences only, see suspension_regression.h.
struct CornerSample {
  Stamp stamp{};
  double sprung_acceleration = 0.0;    ///< z'' [m/s^2], body side of the strut
  double unsprung_acceleration = 0.0;  ///< w'' [m/s^2], wheel carrier side of the strut
};

}  // namespace suspension_health_monitor
