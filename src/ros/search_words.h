#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/discrepancy/effect_search.h"

namespace suspension_health_monitor {

/// The verdict's name for programs: effect_found, nothing_missing or unexplained.
const char* nameOf(Verdict verdict);

/// The verdict in a sentence for people.
std::string sentence(const SearchResult& result);

/// @return the names one after the other with `separator` between them.
std::string join(const std::vector<std::string>& names, const char* separator);

}  // namespace suspension_health_monitor
