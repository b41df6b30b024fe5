#pragma once

#include <string>
#include <vector>

namespace suspension_health_monitor {

/// For a message that refuses an unknown name.
/// @return "; the nearest known name is ...": the only one that begins like this, or the one with the smallest share of
/// letters to change (Levenshtein's distance); empty if that is more than half of them.
std::string suggestNearest(const std::string& name, const std::vector<std::string>& known);

}  // namespace suspension_health_monitor
