#pragma once

#include <nlohmann/json.hpp>

#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {

/// What a search found, for people: the verdict in a sentence, the ranked table, before and after.
void printSearch(const Diagnosis& found);

/// The same for programs.
nlohmann::json toJson(const Diagnosis& found);

}  // namespace suspension_health_monitor
