#include "yaml_settings.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

constexpr int kDeepest = 5;  // no name has more parts; an alias that contains itself has no end

void flatten(const std::string& name, int depth, const YAML::Node& node, const std::string& file, OptionMap& values) {
  if (node.IsMap() && depth < kDeepest) {
    for (const auto& entry : node) {
      const auto key = entry.first.as<std::string>();
      flatten(name.empty() ? key : name + '/' + key, depth + 1, entry.second, file, values);
    }
  } else if (node.IsScalar() && !name.empty()) {
    if (!values.emplace(name, node.as<std::string>()).second)
      throw std::invalid_argument(file + ": line " + std::to_string(node.Mark().line + 1) + ": " + name +
                                  " is given twice, must be given once");
  } else if (!(node.IsNull() && name.empty())) {  // a file of comments only sets nothing
    throw std::invalid_argument(file + ": line " + std::to_string(node.Mark().line + 1) + ": " +
                                (name.empty() ? "the file" : name) + " must be a name with a plain value");
  }
}

}  // namespace

OptionMap readYaml(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw std::invalid_argument(path + ": is a folder, must be a YAML file");
  OptionMap values;
  try {
    flatten("", 0, YAML::LoadFile(path), path, values);
  } catch (const YAML::BadFile&) {
    throw std::invalid_argument(path + ": cannot be read, must be a YAML file");
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(path + ": line " + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
  return values;
}

}  // namespace suspension_health_monitor
