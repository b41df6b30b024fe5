#include "suspension_health_monitor/internal/simulation/strut.h"

#include <algorithm>

namespace suspension_health_monitor {

double Ramp::at(double t) const {
  const double share = std::clamp((t - start) / (end - start), 0.0, 1.0);
  return first + share * (last - first);
}

double EndStops::forcePerMass(double travel) const {
  return stiffness_to_mass * (std::max(0.0, travel - gap) + std::min(0.0, travel + gap));
}

double Strut::forcePerMass(double travel, double travel_rate, double t, const Memory* memory) const {
  double force = damping_to_mass.at(t) * travel_rate + stiffness_to_mass * travel;
  if (end_stops) force += end_stops->forcePerMass(travel);
  for (std::size_t j = 0; j < hidden.size(); ++j) {
    const ActiveEffect& active = hidden[j];
    force += active.coefficient * active.effect.force({travel, travel_rate, t, memory[j]}, active.shapes.data());
  }
  return force;
}

Memory Strut::memoryRate(std::size_t j, const StrutMotion& motion) const {
  const ForceEffect& effect = hidden[j].effect;
  return effect.memory_rate ? effect.memory_rate(motion, hidden[j].shapes.data()) : Memory();
}

}  // namespace suspension_health_monitor
