#pragma once

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/simulation/road.h"

namespace suspension_health_monitor {

/// The paper's road, braked on from `stop` for `brake` seconds to a stand: the speed falls like half a cosine.
inline Road brakedPaperRoad(double stop, double brake) {
  return [=](double t) {
    const double x = std::clamp(t - stop, 0.0, brake), angle = M_PI * x / brake;
    const double s = std::min(t, stop) + 0.5 * x + 0.5 * brake / M_PI * std::sin(angle);
    const double rate = 0.5 + 0.5 * std::cos(angle), slowing = -0.5 * M_PI / brake * std::sin(angle);
    const RoadPoint road = paperRoad(s);
    return RoadPoint{road.height, road.rate * rate, road.acceleration * rate * rate + road.rate * slowing};
  };
}

}  // namespace suspension_health_monitor
