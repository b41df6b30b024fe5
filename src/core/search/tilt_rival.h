#pragma once

#include <string>

#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

inline constexpr const char* kTilt = "mount_tilt";

/// A sensor that is tilted by an angle reads its cosine of all that happens along the strut, gravity above all. What
/// leaks in from across need not show it: of the wheel's IMU nothing else is known.
/// @return true if a fault of the model's reading is an offset or a gain that a tilt of up to 30 degrees makes as well,
/// in drives whose sensors read gravity.
bool mayBeTilt(const StrutModel& model, const std::string& fault, const Records& records);

}  // namespace suspension_health_monitor
