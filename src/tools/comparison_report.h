#pragma once

#include <nlohmann/json.hpp>

#include "suspension_health_monitor/compare.h"

namespace suspension_health_monitor {

/// A comparison for people: the errors by name, where the model fails in sentences, the force that it lacks as a map.
void printComparison(const Comparison& comparison);

/// The same for programs, with the numbers behind every view.
nlohmann::json toJson(const Comparison& comparison);

}  // namespace suspension_health_monitor
