#pragma once

#include <string>

#include "suspension_health_monitor/internal/base/option_table.h"

namespace suspension_health_monitor {

/// @param name  what messages call the text.
/// @return the settings of a YAML text, nested names joined with '/', lists of texts with ", ".
/// @throws std::invalid_argument  naming the text, and the line where it is not a tree of names and plain values, or
/// that it is larger than any settings are: aliases make a small text stand for one without end.
OptionMap parseYaml(const std::string& text, const std::string& name);

/// @return the settings of a YAML file, nested names joined with '/', lists of texts with ", ".
/// @throws std::invalid_argument  naming the file, and the line where it is not a tree of names and plain values.
OptionMap readYaml(const std::string& path);

/// For messages about files that are not there: a node does not run in the folder where it was started from.
/// @return " in FOLDER" of a relative path, empty of an absolute one.
std::string inWhichFolder(const std::string& path);

}  // namespace suspension_health_monitor
