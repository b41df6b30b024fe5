#pragma once

#include <functional>
#include <string>

#include "../ros/shell_options.h"
#include "../ros/strut_sensors.h"
#include "imu_bags.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

/// @return what was kept out, reason by reason: "; rejected clipped: 12"; empty if nothing was.
std::string describeRejected(const RejectCounts& rejected);

/// @return what in the readings may be why they show no strut: "; ..." for each suspicion, empty without any.
std::string describeSuspicions(const UniformGrid& grid, bool negative_damping);

/// Reads the bags as samples of the strut: acceleration along the axis, both sensors paired.
/// @param take  called with every sample; returns false to stop.
/// @param take_body  if given, called with what the body's IMU measures across the strut, message by message, in the
/// order of their stamps.
/// @return the sensors after the last reading, with what they have kept out.
/// @throws InputError, TooLittleError  as readImuMessages().
StrutSensors readSamples(const ImuBags& bags, PipelineOptions options,
                         const std::function<bool(const CornerSample&)>& take,
                         const std::function<void(const BodyMotion&)>& take_body = {});

}  // namespace suspension_health_monitor
