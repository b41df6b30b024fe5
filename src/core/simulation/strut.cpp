#include "suspension_health_monitor/simulation/strut.h"

#include <algorithm>

namespace suspension_health_monitor {

double Ramp::at(double t) const {
  const double share = std::clamp((t - start) / (end - start), 0.0, 1.0);
  return first + share * (last - first);
}

double EndStops::forcePerMass(double travel) const {
  return stiffness_to_mass * (std::max(0.0, travel - gap) + std::min(0.0, travel + gap));
}

double Strut::forcePerMass(double travel, double travel_rate, double t) const {
  const double linear = damping_to_mass.at(t) * travel_rate + stiffness_to_mass * travel;
  return end_stops ? linear + end_stops->forcePerMass(travel) : linear;
}

}  // namespace suspension_health_monitor
