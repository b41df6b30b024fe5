#pragma once

#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"

namespace suspension_health_monitor {

/// How much of the body's turning goes with the strut's motion: the share of the mean square of its angular
/// acceleration, about x or y, that travel, travel rate and z'' of a model's free run tell, fitted on the training
/// samples and judged by the rest. A strut that turns its body is not alone on it: something else holds the body, and
/// what that does to the strut's top has the gyro's shape, too, without being a fault of a sensor.
/// @return 0 if nothing is told, or the body's IMU measures no turning.
double shareOfTurning(const Records& records, const HoldOut& held_out, const LinearResponse& motion);

}  // namespace suspension_health_monitor
