#pragma once

#include <string>

#include "suspension_health_monitor/option_table.h"

namespace suspension_health_monitor {

/// @return the settings of a YAML file, nested names joined with '/'.
/// @throws std::invalid_argument  naming the file, and the line where it is not a tree of names and plain values.
OptionMap readYaml(const std::string& path);

}  // namespace suspension_health_monitor
