#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>

#include "suspension_health_monitor/discrepancy/effect_search.h"

namespace suspension_health_monitor {

/// What a search found, for people: the verdict in a sentence, the ranked table, before and after.
void printSearch(const SearchResult& result);

/// The same for programs.
nlohmann::json toJson(const SearchResult& result);

/// The selected model (the base one if nothing was found) as settings: b1, b0, effects/NAME/...
void writeModel(const SearchResult& result, std::FILE* out);

}  // namespace suspension_health_monitor
