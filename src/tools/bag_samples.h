#pragma once

#include <functional>

#include "../ros/shell_options.h"
#include "imu_bags.h"
#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/discrepancy/body_motion.h"

namespace suspension_health_monitor {

/// Reads the bags as samples of the strut: acceleration along the axis, both sensors paired.
/// @param take  called with every sample; returns false to stop.
/// @param take_body  if given, called with what the body's IMU measures across the strut, message by message, in the
/// order of their stamps.
/// @throws InputError, TooLittleError  as readImuMessages().
void readSamples(const ImuBags& bags, PipelineOptions options, const std::function<bool(const CornerSample&)>& take,
                 const std::function<void(const BodyMotion&)>& take_body = {});

}  // namespace suspension_health_monitor
