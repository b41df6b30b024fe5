#pragma once

#include <chrono>

#include "suspension_health_monitor/internal/base/corner_sample.h"

namespace suspension_health_monitor {

inline Stamp at(int milliseconds) { return std::chrono::milliseconds(milliseconds); }

}  // namespace suspension_health_monitor
