#pragma once

#include <functional>

#include "../ros/shell_options.h"
#include "imu_bags.h"
#include "suspension_health_monitor/corner_sample.h"

namespace suspension_health_monitor {

/// Reads the bags as samples of the strut: acceleration along the axis, both sensors paired.
/// @param take  called with every sample; returns false to stop.
/// @throws InputError, TooLittleError  as readImuMessages().
void readSamples(const ImuBags& bags, const PipelineOptions& options,
                 const std::function<bool(const CornerSample&)>& take);

}  // namespace suspension_health_monitor
