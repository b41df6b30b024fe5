#pragma once

#include <functional>

namespace suspension_health_monitor {

/// The road under the wheel at one instant, and how it changes as the wheel rolls on.
struct RoadPoint {
  double height = 0.0;        ///< mu [m], up positive
  double rate = 0.0;          ///< mu' [m/s]
  double acceleration = 0.0;  ///< mu'' [m/s^2]
};

RoadPoint operator+(const RoadPoint& a, const RoadPoint& b);

/// The road as the wheel meets it, by time t [s] since the start of the drive. The derivatives belong to the height.
/// A road may keep a cache: use one copy per thread.
using Road = std::function<RoadPoint(double t)>;

/// Paper, equation (31): mu = sum G_i (1 - cos(2 pi t / T_i)), G = 1, 2, 3, 4 cm, T = 1.3, 1.9, 2.5, 2.8 s.
/// The T_i are periods; at t = 0 height and rate are 0.
RoadPoint paperRoad(double t);

/// Paper, equation (32): delta = sum H exp(-alpha (t - tau_i)^2), H = 15 cm, alpha = 22.2 1/s^2, tau = 85 s and 110 s.
RoadPoint paperBumps(double t);

}  // namespace suspension_health_monitor
