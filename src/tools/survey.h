#pragma once

#include "../ros/shell_options.h"
#include "imu_bags.h"

namespace suspension_health_monitor {

/// Measures what the settings leave open from the beginning of the bags: sample_period as the median spacing of the
/// stamps, the horizon by matching the filter to the strut (horizon_survey.h).
/// @throws InputError  as readImuMessages().  @throws TooLittleError  if there are too few messages to tell.
void measureOpenSettings(const ImuBags& bags, PipelineOptions& options);

}  // namespace suspension_health_monitor
