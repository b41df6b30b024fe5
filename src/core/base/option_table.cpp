#include "suspension_health_monitor/internal/base/option_table.h"

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <boost/lexical_cast/try_lexical_convert.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kLongestName = 200, kLongestNameOfOne = 64;  // [characters]: with its groups, of one

/// Names that were options once, separated by spaces, and what serves instead.
constexpr std::pair<std::string_view, std::string_view> kFormerOptions[] = {
    {"integration_rule forgetting_rule initial_variance initial_variance_rule la/start_rows la/small_divisor_rule "
     "la/small_divisor la/scale_covariance_at_start",
     "preset: paper has the paper's value"},
    {"horizon_samples", "integration_horizon gives the horizon in seconds"},
    {"tyre/integration_horizon", "it is an eighth of integration_horizon"},
    {"tyre/enabled", "identify --road-topic identifies the tyre of a recorded drive"},
    {"hardware_id", "it is the name of the node"},
    {"fastest_memory", "the estimate follows a change of the strut by itself"},
    {"damping_ramp", "damping_end_fraction: 1 makes a healthy drive"},
    {"sprung_rate", "it is rate; that of the other sensor is unsprung_rate"},
    {"valid/min_rows valid/min_explained health/hysteresis health/min_significance health/early_change "
     "health/false_alarm_interval health/gravity_tolerance expected_rate/tolerance queue_size diagnose/threads "
     "significance ramp_start ramp_end noise_distribution gyro_noise wait_for_subscribers",
     "its default always holds"},
};

// A number may come as text: command lines have nothing else, and YAML 1.1 reads 1e-8 (no dot) as text.
std::optional<double> asNumber(const OptionValue& value) {
  double number = 0.0;
  if (const auto* d = std::get_if<double>(&value)) return *d;
  if (const auto* i = std::get_if<int>(&value)) return *i;
  const auto* text = std::get_if<std::string>(&value);
  if (text != nullptr && boost::conversion::try_lexical_convert(*text, number)) return number;
  return std::nullopt;
}

std::string format(const OptionValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return '"' + shortened(*text) + '"';
  if (const auto* list = std::get_if<UnusableList>(&value)) return shortened(list->text);
  if (const auto* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  return numberText(*asNumber(value));
}

bool isChoice(std::string_view choices, const std::string& word) {
  return !word.empty() && word.find(' ') == std::string::npos &&
         (' ' + std::string(choices) + ' ').find(' ' + word + ' ') != std::string::npos;
}

std::string allowedText(const option_table::Bound& option) {
  if (std::holds_alternative<bool*>(option.member)) return "true or false";
  if (std::holds_alternative<std::string*>(option.member)) {
    if (option.choices.empty()) return "any text";
    return "one of " + boost::algorithm::replace_all_copy(std::string(option.choices), " ", ", ");
  }
  const char* const whole = std::holds_alternative<int*>(option.member) ? "a whole number " : "";
  return whole + ("in [" + numberText(option.min)) + ", " + numberText(option.max) + "]";
}

[[noreturn]] void refuse(const option_table::Bound& option, const OptionValue& value) {
  const bool any_text = std::holds_alternative<std::string*>(option.member) && option.choices.empty();
  const char* const or_list = any_text && std::holds_alternative<UnusableList>(value) ? " or a list of texts" : "";
  throw std::invalid_argument(std::string(option.name) + " = " + format(value) + " [" + std::string(option.unit) +
                              "], must be " + allowedText(option) + or_list + ": " + std::string(option.help));
}

// Each takes a value as one of the kind of an option, which the type of the second argument tells; nothing if they
// differ.

// A whole number may be written as 30 or 30.0; anything with a fraction is refused.
std::optional<int> converted(const OptionValue& value, const int* /*kind*/) {
  const std::optional<double> number = asNumber(value);
  if (number && std::abs(*number) <= std::numeric_limits<int>::max() && std::trunc(*number) == *number)
    return static_cast<int>(*number);
  return std::nullopt;
}

std::optional<bool> converted(const OptionValue& value, const bool* /*kind*/) {
  if (const auto* b = std::get_if<bool>(&value)) return *b;
  const auto* text = std::get_if<std::string>(&value);
  if (text != nullptr && (*text == "true" || *text == "True")) return true;
  if (text != nullptr && (*text == "false" || *text == "False")) return false;
  return std::nullopt;
}

std::optional<std::string> converted(const OptionValue& value, const std::string* /*kind*/) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* i = std::get_if<int>(&value)) return std::to_string(*i);  // a name such as 17
  return std::nullopt;
}

template <class Number>  // double or std::optional<double>
std::optional<double> converted(const OptionValue& value, const Number* /*kind*/) {
  return asNumber(value);
}

/// @throws std::invalid_argument  if a name is longer than any that somebody has chosen.
void requireNameLength(const std::string& name) {
  if (name.size() > kLongestName)
    throw std::invalid_argument("name " + shortened(name) + ", must be at most " + std::to_string(kLongestName) +
                                " characters");
}

}  // namespace

namespace option_table {

std::optional<OptionValue> valueOf(const Bound& option) {
  return std::visit([](const auto* value) -> std::optional<OptionValue> { return *value; }, option.member);
}

void assign(const Bound& option, const OptionValue& value) {
  const auto copy = [&](auto* target) {
    const auto source = converted(value, target);
    if (source) *target = *source;
    return source.has_value();
  };
  if (!std::visit(copy, option.member)) refuse(option, value);
}

void check(const Bound& option) {
  const std::optional<OptionValue> value = valueOf(option);
  if (!value) return;
  if (const auto* text = std::get_if<std::string>(&*value)) {
    if (!option.choices.empty() && !isChoice(option.choices, *text)) refuse(option, *value);
  } else if (const std::optional<double> number = asNumber(*value)) {
    if (!(*number >= option.min && *number <= option.max)) refuse(option, *value);
  }
}

OptionDescription describe(const Bound& option) {
  const std::optional<OptionValue> value = valueOf(option);
  const auto* text = value ? std::get_if<std::string>(&*value) : nullptr;
  const bool has_words = text != nullptr && !text->empty();
  return {std::string(option.group), std::string(option.name), std::string(option.unit),
          std::string(option.help),  allowedText(option),      has_words ? *text : value ? format(*value) : "none"};
}

}  // namespace option_table

void refuseUnknown(const OptionMap& values, const std::vector<OptionDescription>& known) {
  if (values.empty()) return;
  const std::string& name = values.begin()->first;
  for (const auto& [names, instead] : kFormerOptions)
    if (isChoice(names, name)) throw std::invalid_argument(name + " is no option any more: " + std::string(instead));
  requireNameLength(name);
  throw std::invalid_argument("unknown option " + shortened(name) + " = " + format(values.begin()->second) +
                              suggestNearest(name, namesOf(known)));
}

std::vector<OptionDescription> inGroups(const std::vector<std::string>& groups, std::vector<OptionDescription> first,
                                        const std::vector<OptionDescription>& second) {
  first.insert(first.end(), second.begin(), second.end());
  const auto place = [&](const OptionDescription& option) {
    return std::find(groups.begin(), groups.end(), option.group);
  };
  std::stable_sort(first.begin(), first.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return first;
}

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
  const option_table::Bound option{{{}, name, "SI", "a number", min, max, {}}, &number};
  option_table::assign(option, value);
  option_table::check(option);
  return number;
}

void requireName(const std::string& where, const std::string& name) {
  if (name.find_first_of(kLetters) != 0 || name.find_first_not_of(kNameCharacters) != std::string::npos)
    throw std::invalid_argument(where + ": the name must be letters, digits and _, a letter first");
  if (name.size() > kLongestNameOfOne)
    throw std::invalid_argument(where + ": the name must be at most " + std::to_string(kLongestNameOfOne) +
                                " characters");
}

}  // namespace suspension_health_monitor
