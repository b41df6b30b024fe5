#pragma once

#include <array>
#include <string>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/discrepancy/drive_record.h"
#include "suspension_health_monitor/model/effect_library.h"

namespace suspension_health_monitor {

/// What one message of the body's IMU tells besides z'', in the strut's frame: z up along the strut, x and y across it,
/// right-handed. Kept beside the samples of the strut, which estimation lives on.
struct BodyMotion {
  Stamp stamp{};
  std::array<double, 2> acceleration{};  ///< along x, y [m/s^2]; NaN: not measured
  std::array<double, 2> angular_rate{};  ///< about x, y [rad/s]; NaN: not measured
};

/// An effect that some drives cannot tell, and why.
struct UntestableEffect {
  std::string name, reason;
};

/// Takes the effects out of `library` that need a channel which is empty in one of the records.
std::vector<UntestableEffect> takeUntestable(EffectLibrary& library, const std::vector<const DriveRecord*>& records);

}  // namespace suspension_health_monitor
