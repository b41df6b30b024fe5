#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/option_table.h"

namespace suspension_health_monitor {

/// @return the settings of a YAML file, nested names joined with '/'.
/// @throws std::invalid_argument  naming the file, and the line where it is not a tree of names and plain values.
OptionMap readYaml(const std::string& path);

/// Takes `NAME=VALUE` into `values`, replacing what is there.
/// @throws std::invalid_argument  if there is no '=' or no name.
void set(OptionMap& values, const std::string& assignment);

/// Settings from an optional --config file and --set assignments that override it.
OptionMap gatherOptions(const std::string& config_file, const std::vector<std::string>& assignments);

}  // namespace suspension_health_monitor
