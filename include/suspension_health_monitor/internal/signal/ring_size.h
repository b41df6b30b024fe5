#pragma once

#include <cstddef>

namespace suspension_health_monitor {

/// @return number of places of a ring that keeps the newest `length` >= 1 values: the power of two from there on, so
/// that an index wraps by a mask, which is one less.
inline std::size_t ringSize(std::size_t length) {
  std::size_t size = 1;
  while (size < length) size *= 2;
  return size;
}

}  // namespace suspension_health_monitor
