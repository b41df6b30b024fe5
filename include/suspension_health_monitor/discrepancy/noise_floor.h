#pragma once

#include <vector>

#include "suspension_health_monitor/discrepancy/drive_record.h"
#include "suspension_health_monitor/model/strut_model.h"

namespace suspension_health_monitor {

/// Estimates what the noise of both sensors leaves of a free run [m/s^2], without knowing the model's faults.
///
/// The noise of the body's sensor is what a long linear interpolation of z'' from its own neighbours before and after,
/// and from w'' around it, cannot tell: forces that are missing from the model change slowly against the sampling and
/// are interpolated, white noise is not. From the median, so that a blow into an end stop is no noise, and with such
/// blows kept out of the interpolation's fit. The wheel's sensor is taken to be as noisy; its noise comes through the
/// model.
/// @return 0 if there are too few samples to tell.
double estimateNoiseFloor(const std::vector<const DriveRecord*>& records, const StrutModel& model);

}  // namespace suspension_health_monitor
