#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/discrepancy/linear_response.h"

namespace suspension_health_monitor {

/// The kind of drive on which models differ that the present drives cannot tell apart: of several kinds (rougher,
/// smoother, slower, quicker, longer) the one in which the least different of them differs most from the first, their
/// forces taken along the present motion scaled to that kind.
/// @param names, models  the group, one model per name.
/// @return a sentence for people; it says so if no kind would help.
std::string suggestSeparatingDrive(const LinearResponse& present, const std::vector<std::string>& names,
                                   const std::vector<StrutModel>& models);

/// What to do next when no candidate explains the structure.
/// @param surface_share  share of it that a free-form force over travel and travel rate would explain.
/// @param power_at_limit  see powerAtSamplingLimit().
std::string suggestDriveForUnexplained(double surface_share, double power_at_limit);

}  // namespace suspension_health_monitor
