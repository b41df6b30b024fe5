#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/internal/option_table.h"

namespace suspension_health_monitor {

/// Takes `NAME=VALUE` into `values`, replacing what is there.
/// @throws std::invalid_argument  if there is no '=' or no name.
void set(OptionMap& values, const std::string& assignment);

/// Settings from an optional --config file and --set assignments that override it.
OptionMap gatherOptions(const std::string& config_file, const std::vector<std::string>& assignments);

}  // namespace suspension_health_monitor
