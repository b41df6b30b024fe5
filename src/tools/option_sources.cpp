#include "option_sources.h"

#include <stdexcept>

#include "../ros/yaml_settings.h"

namespace suspension_health_monitor {

void set(OptionMap& values, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw std::invalid_argument("--set " + assignment + ", must be NAME=VALUE");
  values[assignment.substr(0, equals)] = assignment.substr(equals + 1);
}

OptionMap gatherOptions(const std::string& config_file, const std::vector<std::string>& assignments) {
  OptionMap values;
  if (!config_file.empty()) values = readYaml(config_file);
  for (const std::string& assignment : assignments) set(values, assignment);
  return values;
}

}  // namespace suspension_health_monitor
