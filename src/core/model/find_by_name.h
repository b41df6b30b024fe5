#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

/// @param besides  what else the message has to say.
/// @return the record of that name.  @throws std::invalid_argument  naming the unknown name and the known ones.
template <class Record>
const Record& findByName(const std::vector<Record>& records, std::string_view name, const std::string& besides = {}) {
  const auto found = std::find_if(records.begin(), records.end(), [&](const Record& r) { return r.name == name; });
  if (found != records.end()) return *found;
  const std::vector<std::string> known = namesOf(records);
  throw std::invalid_argument("effect " + std::string(name) + ", must be one of " + join(known) + besides +
                              suggestNearest(std::string(name), known));
}

}  // namespace suspension_health_monitor
