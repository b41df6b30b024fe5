#include "separate_files.h"

#include <filesystem>
#include <set>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> paths(const boost::program_options::variables_map& values, const std::string& option) {
  if (values.count(option) == 0) return {};
  if (const auto* path = boost::any_cast<std::string>(&values[option].value())) return {*path};
  return values[option].as<std::vector<std::string>>();
}

}  // namespace

void requireSeparateFiles(const boost::program_options::variables_map& values, const std::vector<std::string>& inputs,
                          const std::vector<std::string>& outputs) {
  std::error_code error;
  std::set<fs::path> taken;
  for (const std::string& option : inputs)
    for (const std::string& path : paths(values, option)) taken.insert(fs::weakly_canonical(path, error));
  taken.erase("");  // an option that was not given
  for (const std::string& option : outputs)
    for (const std::string& path : paths(values, option)) {
      const fs::path full = fs::weakly_canonical(path, error);
      const bool is_new = full.empty() || taken.insert(full).second;
      if (!is_new && (fs::is_regular_file(path, error) || !fs::exists(path, error)))
        throw std::invalid_argument("--" + option + " " + path + ", must be a file of its own: it is used already");
    }
}

}  // namespace suspension_health_monitor
