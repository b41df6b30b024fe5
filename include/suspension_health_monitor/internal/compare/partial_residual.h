#pragma once

#include <vector>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// @param segments  compared by the model.  @param motion  of the free run, per segment and sample.
/// @return one per effect of the model, in its order; what the reading does is no force.
std::vector<PartialResidual> partialResiduals(const std::vector<ComparedSegment>& segments,
                                              const std::vector<std::vector<StrutState>>& motion,
                                              const StrutModel& model);

}  // namespace suspension_health_monitor
