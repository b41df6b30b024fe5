#pragma once

#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/option_table.h"

namespace suspension_health_monitor {

/// @param name  what messages call the text.
/// @return the settings of a YAML text, nested names joined with '/', lists of texts with ", ".
/// @throws std::invalid_argument  naming the text, and the line where it is not a tree of names and plain values, or
/// that it is larger than any settings are: aliases make a small text stand for one without end.
OptionMap parseYaml(const std::string& text, const std::string& name);

/// @return the settings of a YAML file, nested names joined with '/', lists of texts with ", ".
/// @throws std::invalid_argument  naming the file, and the line where it is not a tree of names and plain values.
OptionMap readYaml(const std::string& path);

/// @return what work() returns; the words of a std::invalid_argument that it throws get `prefix` in front.
template <class Work>
auto prefixed(const std::string& prefix, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(prefix + error.what());
  }
}

}  // namespace suspension_health_monitor
