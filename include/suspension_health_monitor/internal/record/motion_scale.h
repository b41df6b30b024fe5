#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// How far and how fast a strut moves on a drive: what shape parameters are measured in (ShapeScale).
struct MotionScale {
  double travel = 0.0;       ///< rms of d less its mean [m]
  double travel_rate = 0.0;  ///< rms of v [m/s]
  double time = 0.0;         ///< 1/sqrt(b0) [s]

  /// @return one unit of the scale in SI.
  double unit(ShapeScale scale) const;
};

/// @return true if a shape of the effect lies within a hundredth of its range (in the logarithm) of an end that is not
/// open, or beyond.
bool hasShapeAtEnd(const ActiveEffect& active, const MotionScale& scale);

/// The scale of a drive by a free run of the linear strut over its samples.
/// @param samples  in the order of time; the run starts anew at gaps.  @param period  sampling time T [s].
/// @return nothing if the model is not stable or nothing moves long enough for the run to settle.
std::optional<MotionScale> motionScale(const std::vector<CornerSample>& samples, double period, double damping_to_mass,
                                       double stiffness_to_mass);

}  // namespace suspension_health_monitor
