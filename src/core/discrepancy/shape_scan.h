#pragma once

#include <vector>

#include "suspension_health_monitor/model/effect.h"

namespace suspension_health_monitor {

/// What the shapes of an effect are measured in.
struct MotionScales {
  double travel, travel_rate, natural_time;  ///< rms [m], rms [m/s], 1/sqrt(b0) [s]

  /// @return one unit of the shape's scale, in SI.
  double of(const ShapeParameter& shape) const;
};

/// @return shapes of the effect in SI, spread evenly in ratio over their ranges: at most 64 combinations, one (empty)
/// for an effect without shapes.
std::vector<std::vector<double>> scanShapes(const ForceEffect& effect, const MotionScales& scales);

}  // namespace suspension_health_monitor
