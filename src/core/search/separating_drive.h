#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/internal/fit/linear_response.h"
#include "suspension_health_monitor/internal/search/effect_search.h"

namespace suspension_health_monitor {

/// The kind of drive on which models differ that the present drives cannot tell apart: of several kinds (rougher,
/// smoother, slower, quicker, longer) the one in which the least different of them differs most from the first, their
/// forces taken along the present motion scaled to that kind. kNoneHelps if none makes it at least twice as much.
/// @param names, models  the group, one model per name.
SeparatingDrive separatingDrive(const LinearResponse& present, const std::vector<std::string>& names,
                                const std::vector<StrutModel>& models);

}  // namespace suspension_health_monitor
