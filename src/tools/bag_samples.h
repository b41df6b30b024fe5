#pragma once

#include <functional>

#include "../ros/shell_options.h"
#include "imu_bags.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/signal/stream_grid.h"

namespace suspension_health_monitor {

/// What came of reading samples.
struct ReadSamples {
  StreamGrid grid;  ///< after the last reading
  RejectCounts rejected;
};

/// Reads the bags as samples of the strut: acceleration along the axis, both sensors aligned.
/// @param take  called with every sample; returns false to stop.
/// @param take_body  if given, called with what the body's IMU measures across the strut, message by message, in the
/// order of their stamps.
/// @throws InputError, TooLittleError  as readImuMessages().
ReadSamples readSamples(const ImuBags& bags, const PipelineOptions& options,
                        const std::function<bool(const CornerSample&)>& take,
                        const std::function<void(const BodyMotion&)>& take_body = {});

}  // namespace suspension_health_monitor
