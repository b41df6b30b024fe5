#pragma once

#include <nlohmann/json.hpp>

#include "suspension_health_monitor/discrepancy/effect_search.h"

namespace suspension_health_monitor {

/// What a search found, for people: the verdict in a sentence, the ranked table, before and after.
void printSearch(const SearchResult& result);

/// The same for programs.
nlohmann::json toJson(const SearchResult& result);

}  // namespace suspension_health_monitor
