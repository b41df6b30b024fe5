#pragma once

#include <nlohmann/json.hpp>

#include "suspension_health_monitor/internal/compare/travel_statistics.h"

namespace suspension_health_monitor {

/// Tells people how far and how fast a strut moves, and how its stops are used; nothing of one that does not move.
void printTravel(const TravelStatistics& travel);

nlohmann::json toJson(const TravelStatistics& travel);

}  // namespace suspension_health_monitor
