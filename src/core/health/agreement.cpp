#include "suspension_health_monitor/internal/health/agreement.h"

#include <cmath>

namespace suspension_health_monitor {

void Agreement::update(const StrutEstimate& ls, const StrutEstimate& la) {
  const auto agree = [&](double StrutEstimate::*value, double StrutEstimate::*stddev) {
    return std::abs(ls.*value - la.*value) <= kMostApart * la.*stddev && ls.*stddev <= kTails * la.*stddev;
  };
  const bool holds = agree(&StrutEstimate::damping_to_mass, &StrutEstimate::damping_to_mass_stddev) &&
                     agree(&StrutEstimate::stiffness_to_mass, &StrutEstimate::stiffness_to_mass_stddev);
  failing_ += ((holds ? 0.0 : 1.0) - failing_) / kMemory;
}

}  // namespace suspension_health_monitor
