#include "suspension_health_monitor/internal/health/agreement.h"

#include <cmath>

namespace suspension_health_monitor {

void Agreement::update(const StrutEstimate& ls, const StrutEstimate& la, double memory) {
  holds_ =
      ls.valid() &&
      !areApart(ls.damping_to_mass, la.damping_to_mass, ls.damping_to_mass_stddev, la.damping_to_mass_stddev) &&
      !areApart(ls.stiffness_to_mass, la.stiffness_to_mass, ls.stiffness_to_mass_stddev, la.stiffness_to_mass_stddev);
  failing_ += ((holds_ ? 0.0 : 1.0) - failing_) / (kMemories * memory);
}

bool Agreement::areApart(double ls, double la, double ls_stddev, double la_stddev) {
  return std::abs(ls - la) > kMostApart * la_stddev || ls_stddev > kTails * la_stddev;
}

}  // namespace suspension_health_monitor
