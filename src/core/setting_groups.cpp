#include "suspension_health_monitor/internal/setting_groups.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kLongestNameOfOne = 64;  // [characters]

}  // namespace

OptionMap takePrefixed(OptionMap& values, const std::string& prefix) {
  const std::string start = prefix + '/';
  OptionMap taken;
  for (auto entry = values.lower_bound(start);
       entry != values.end() && entry->first.compare(0, start.size(), start) == 0; entry = values.erase(entry))
    taken.emplace(entry->first.substr(start.size()), std::move(entry->second));
  return taken;
}

std::map<std::string, OptionMap> takeGroups(OptionMap& values, const std::string& prefix) {
  std::map<std::string, OptionMap> groups;
  for (const auto& [key, value] : takePrefixed(values, prefix)) {
    const std::string whole = prefix + '/' + key;
    requireNameLength(whole);
    const std::size_t slash = key.find('/');
    if (slash == std::string::npos || slash == 0)
      throw std::invalid_argument(whole + " must be " + prefix + "/NAME/SETTING");
    groups[key.substr(0, slash)][key.substr(slash + 1)] = value;
  }
  return groups;
}

std::vector<double> takeNumbers(const std::string& group, const OptionMap& settings,
                                const std::vector<std::string>& wanted) {
  const std::string has = "it has " + join(wanted);
  for (const auto& [key, value] : settings)
    if (std::find(wanted.begin(), wanted.end(), key) == wanted.end())
      throw std::invalid_argument(group + '/' + key + " is unknown; " + has);
  std::vector<double> numbers;
  for (const std::string& name : wanted) {
    const auto found = settings.find(name);
    if (found == settings.end()) throw std::invalid_argument(group + '/' + name + " is missing; " + has);
    numbers.push_back(toNumber(group + '/' + name, found->second));
  }
  return numbers;
}

double toNumber(const std::string& name, const OptionValue& value, double min, double max) {
  double number = min;
  const option_table::Bound option{{}, name, "SI", "a number", &number, min, max, {}};
  option_table::assign(option, value);
  option_table::check(option);
  return number;
}

void requireName(const std::string& where, const std::string& name) {
  static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  if (name.find_first_of(letters) != 0 || name.find_first_not_of(letters + "0123456789_") != std::string::npos)
    throw std::invalid_argument(where + ": the name must be letters, digits and _, a letter first");
  if (name.size() > kLongestNameOfOne)
    throw std::invalid_argument(where + ": the name must be at most " + std::to_string(kLongestNameOfOne) +
                                " characters");
}

}  // namespace suspension_health_monitor
