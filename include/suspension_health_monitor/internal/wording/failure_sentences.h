#pragma once

#include <vector>

#include "suspension_health_monitor/compare.h"

namespace suspension_health_monitor {

/// Puts regions into words: fills `region` and `sentence` from the facts.
/// @param views, noise_floor  of the comparison that found them: numbers get the SI prefix that reads well for its
/// drives.
void describeFailures(const ResidualViews& views, double noise_floor, std::vector<FailureRegion>& regions);

}  // namespace suspension_health_monitor
