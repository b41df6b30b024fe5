#include "suspension_health_monitor/internal/health/agreement.h"

#include <cmath>

namespace suspension_health_monitor {

void Agreement::update(const StrutEstimate& ls, const StrutEstimate& la, double memory) {
  const bool scatter_is_known = ls.scatter_is_known && la.scatter_is_known;
  const auto agree = [&](double StrutEstimate::*value, double StrutEstimate::*stddev) {
    const bool are_apart = std::abs(ls.*value - la.*value) > kMostApart * la.*stddev;
    return !are_apart && !(scatter_is_known && ls.*stddev > kTails * la.*stddev);
  };
  holds_ = ls.valid() && agree(&StrutEstimate::damping_to_mass, &StrutEstimate::damping_to_mass_stddev) &&
           agree(&StrutEstimate::stiffness_to_mass, &StrutEstimate::stiffness_to_mass_stddev);
  failing_ += ((holds_ ? 0.0 : 1.0) - failing_) / (kMemories * memory);
}

}  // namespace suspension_health_monitor
