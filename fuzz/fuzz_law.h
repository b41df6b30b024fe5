#pragma once

#include <stdexcept>
#include <string>

namespace suspension_health_monitor {

/// @throws std::logic_error  naming the law, if it does not hold.
inline void require(bool holds, const char* law) {
  if (!holds) throw std::logic_error(std::string("broken law: ") + law);
}

}  // namespace suspension_health_monitor
