#pragma once

#include "../ros/shell_options.h"
#include "imu_bags.h"

namespace suspension_health_monitor {

/// @return the mean spacing of the stamps at the beginning of the bags, of the slowest topic that is needed [s].
/// @throws InputError  as readTopics(), or it is no sample_period.  @throws TooLittleError  if there are too few
/// messages.
double measurePeriod(const ImuBags& bags);

/// Measures what the settings leave open: sample_period by measurePeriod(), the horizon by proposeHorizon() with what
/// blocks tell of the strut: those of the beginning, as soon as they know it well enough.
/// @param clocks_may_differ  true: a strut that blocks see once the clocks are set right (rough_strut.h) will do.
/// @throws InputError  as readImuMessages().  @throws TooLittleError  if there are too few messages to tell.
void measureOpenSettings(const ImuBags& bags, PipelineOptions& options, bool clocks_may_differ);

/// @throws std::invalid_argument  if sample_period is so far below the spacing of the stamps at the beginning of the
/// bags that nearly all samples would be made up. Bags whose stamps tell no spacing are left to what reads them.
void requireFittingPeriod(const ImuBags& bags, double sample_period);

}  // namespace suspension_health_monitor
