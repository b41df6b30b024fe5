#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

#include <stdexcept>
#include <string>

namespace suspension_health_monitor {

void requireNumStruts(std::size_t count) {
  if (count < 1 || count > static_cast<std::size_t>(kMostStruts))
    throw std::invalid_argument(std::to_string(count) + " struts, must be 1 to " + std::to_string(kMostStruts));
}

void requireNumKnownForces(std::size_t count) {
  if (count > static_cast<std::size_t>(kMostKnownForces))
    throw std::invalid_argument(std::to_string(count) + " known forces, must be at most " +
                                std::to_string(kMostKnownForces));
}

}  // namespace suspension_health_monitor
