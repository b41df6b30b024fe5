#pragma once

#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/record/motion_scale.h"

namespace suspension_health_monitor {

/// @return shapes of the effect in SI, spread evenly in ratio over their ranges: at most 64 combinations, one (empty)
/// for an effect without shapes.
std::vector<std::vector<double>> scanShapes(const ForceEffect& effect, const MotionScale& scales);

}  // namespace suspension_health_monitor
