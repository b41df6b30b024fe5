#include "suspension_health_monitor/internal/simulation/road.h"

#include <cmath>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

struct Wave {
  double amplitude;  // [m]
  double period;     // [s]
};
constexpr Wave kWaves[] = {{0.01, 1.3}, {0.02, 1.9}, {0.03, 2.5}, {0.04, 2.8}};

constexpr double kBumpHeight = 0.15;            // [m]
constexpr double kBumpSharpness = 22.2;         // alpha [1/s^2]
constexpr double kBumpTimes[] = {85.0, 110.0};  // [s]

}  // namespace

RoadPoint operator+(const RoadPoint& a, const RoadPoint& b) {
  return {a.height + b.height, a.rate + b.rate, a.acceleration + b.acceleration};
}

RoadPoint paperRoad(double t) {
  RoadPoint sum;
  for (const Wave& wave : kWaves) {
    const double omega = 2.0 * kPi / wave.period;
    const double cosine = std::cos(omega * t);
    sum = sum + RoadPoint{wave.amplitude * (1.0 - cosine), wave.amplitude * omega * std::sin(omega * t),
                          wave.amplitude * omega * omega * cosine};
  }
  return sum;
}

RoadPoint paperBumps(double t) {
  RoadPoint sum;
  for (const double centre : kBumpTimes) {
    const double x = t - centre;
    const double height = kBumpHeight * std::exp(-kBumpSharpness * x * x);
    const double slope = -2.0 * kBumpSharpness * x;
    sum = sum + RoadPoint{height, slope * height, (slope * slope - 2.0 * kBumpSharpness) * height};
  }
  return sum;
}

}  // namespace suspension_health_monitor
