#pragma once

#include <vector>

#include "suspension_health_monitor/discrepancy/motion_scale.h"
#include "suspension_health_monitor/model/effect.h"

namespace suspension_health_monitor {

/// @return shapes of the effect in SI, spread evenly in ratio over their ranges: at most 64 combinations, one (empty)
/// for an effect without shapes.
std::vector<std::vector<double>> scanShapes(const ForceEffect& effect, const MotionScale& scales);

}  // namespace suspension_health_monitor
