#pragma once

#include <string>

#include "suspension_health_monitor/internal/vehicle/imu_survey.h"

namespace suspension_health_monitor {

/// @param axis  of the IMU that points up or down.  @param moved  rms along it, of the body's and the wheel's motion.
/// @return what is wrong with the readings of an IMU, the worst first, and what to do, in a sentence; empty: nothing.
std::string describeFault(const ImuSurvey& imu, int axis, double moved);

}  // namespace suspension_health_monitor
