#pragma once

#include "../ros/shell_options.h"
#include "imu_bags.h"

namespace suspension_health_monitor {

/// Measures what the settings leave open: sample_period as the mean spacing of the stamps at the beginning of the bags,
/// the horizon by matching the filter to the strut (horizon_survey.h) in stretches that lie all over the drive, or, if
/// these show no strut clearly, in all of it.
/// @param clocks_may_differ  true: a horizon that shows a strut once the clocks are set right (clock_lag.h) will do.
/// @throws InputError  as readImuMessages().  @throws TooLittleError  if there are too few messages to tell.
void measureOpenSettings(const ImuBags& bags, PipelineOptions& options, bool clocks_may_differ);

/// @throws std::invalid_argument  if sample_period is so far below the spacing of the stamps at the beginning of the
/// bags that nearly all samples would be made up. Bags whose stamps tell no spacing are left to what reads them.
void requireFittingPeriod(const ImuBags& bags, double sample_period);

}  // namespace suspension_health_monitor
