#pragma once

#include <stdexcept>
#include <string>

namespace suspension_health_monitor {

/// @return what work() returns; the words of a std::invalid_argument that it throws get `prefix` in front.
template <class Work>
auto prefixed(const std::string& prefix, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(prefix + error.what());
  }
}

}  // namespace suspension_health_monitor
