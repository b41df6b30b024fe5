#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

/// A list of something other than texts, or an empty group. No option takes it: it is refused like any other wrong
/// value.
struct UnusableList {
  std::string text;  ///< as it was written
  bool operator==(const UnusableList& other) const { return text == other.text; }
};

/// A value as a parameter server, a YAML file or a command line delivers it. A list of texts comes as one text with
/// commas.
using OptionValue = std::variant<bool, int, double, std::string, UnusableList>;

/// Values by full name; a nested YAML key is joined with '/', as on the ROS parameter server: `health/damping_warn`.
using OptionMap = std::map<std::string, OptionValue>;

/// What is said of one option, and what it may be.
struct OptionTraits {
  std::string_view group;  ///< under which people are shown it, as "input"; empty: in no table that they see
  std::string_view name;
  std::string_view unit;  ///< "-" without unit
  std::string_view help;
  double min, max;           ///< smallest and largest allowed number
  std::string_view choices;  ///< allowed words, separated by one space; empty: any text
};

/// One option of the struct `Options`: the only place where its name, unit, meaning and range are written.
/// The default is the struct's own initialiser.
template <class Options>
struct OptionField : OptionTraits {
  using Member = std::variant<bool Options::*, int Options::*, double Options::*, std::string Options::*,
                              std::optional<double> Options::*>;

  Member member;

  constexpr OptionField(std::string_view its_name, std::string_view its_unit, std::string_view its_help,
                        Member its_member, double smallest = 0.0, double largest = 0.0, std::string_view words = {})
      : OptionTraits{{}, its_name, its_unit, its_help, smallest, largest, words}, member(its_member) {}

  /// The same with a group in front.
  template <class... Rest>
  constexpr OptionField(std::string_view its_group, std::string_view its_name, std::string_view its_unit,
                        std::string_view its_help, Rest... rest)
      : OptionField(its_name, its_unit, its_help, rest...) {
    group = its_group;
  }
};

/// What a person, a loader or a table in a document needs to know of one option.
struct OptionDescription {
  std::string group, name, unit, help;
  std::string allowed;        ///< "in [0.9, 1]", "one of auto, paired", "true or false", "any text"
  std::string default_value;  ///< "none" where the option may be left out
};

namespace option_table {

using Member = std::variant<bool*, int*, double*, std::string*, std::optional<double>*>;

/// An option bound to the struct instance that holds its value.
struct Bound : OptionTraits {
  Member member;
};

template <class Options>
Bound bind(const OptionField<Options>& field, Options& options) {
  const Member member = std::visit([&](auto pointer) { return Member(&(options.*pointer)); }, field.member);
  return {static_cast<const OptionTraits&>(field), member};
}

/// @return what an option is at present; nothing where it may be left out, and is.
std::optional<OptionValue> valueOf(const Bound& option);

void assign(const Bound& option, const OptionValue& value);
void check(const Bound& option);
OptionDescription describe(const Bound& option);

}  // namespace option_table

/// Checks every option of one struct against its table.
/// @throws std::invalid_argument  naming the option, its value and what is allowed. NaN is outside every range.
template <class Options, std::size_t N>
void validate(const Options& options, const OptionField<Options> (&fields)[N]) {
  Options copy = options;
  for (const OptionField<Options>& field : fields) option_table::check(option_table::bind(field, copy));
}

/// @return the settings, once they have passed their validate(settings).
template <class Settings>
const Settings& validated(const Settings& settings) {
  validate(settings);
  return settings;
}

/// Sets the options that `values` names and removes them from `values`, so that what is left is unknown to this table.
/// @throws std::invalid_argument  on a value of the wrong type or outside its range; `options` is then unchanged.
template <class Options, std::size_t N>
void takeOptions(OptionMap& values, const OptionField<Options> (&fields)[N], Options& options) {
  Options changed = options;
  for (const OptionField<Options>& field : fields) {
    const option_table::Bound option = option_table::bind(field, changed);
    if (const auto found = values.find(std::string(field.name)); found != values.end()) {
      option_table::assign(option, found->second);
      values.erase(found);
    }
    option_table::check(option);
  }
  options = changed;
}

/// @param known  descriptions of all options that the caller understands, to propose the nearest name if one is near.
/// @throws std::invalid_argument  naming the first key that is left in `values`: a misspelt option must not pass. Of a
/// name that was an option once it says what serves instead.
void refuseUnknown(const OptionMap& values, const std::vector<OptionDescription>& known);

/// @return one description per row of the table, with the struct's own defaults.
template <class Options, std::size_t N>
std::vector<OptionDescription> describeOptions(const OptionField<Options> (&fields)[N]) {
  Options defaults;
  return mapped(fields, [&](const auto& field) { return option_table::describe(option_table::bind(field, defaults)); });
}

/// @return the descriptions of both tables, group after group.
/// @param groups  all that there are, in the order wanted; within one the order of the tables is kept.
std::vector<OptionDescription> inGroups(const std::vector<std::string>& groups, std::vector<OptionDescription> first,
                                        const std::vector<OptionDescription>& second);

/// Takes settings `PREFIX/KEY` out of `values`.
/// @return the settings KEY.
OptionMap takePrefixed(OptionMap& values, const std::string& prefix);

/// Takes settings `PREFIX/NAME/KEY` out of `values`.
/// @return by NAME the settings KEY.
/// @throws std::invalid_argument  on a setting `PREFIX/NAME`.
std::map<std::string, OptionMap> takeGroups(OptionMap& values, const std::string& prefix);

/// @param group  where the settings stand, such as `effects/bump_stop`, for messages.
/// @return the numbers called `wanted`, in that order.
/// @throws std::invalid_argument  naming a setting that is missing, unknown or no number.
std::vector<double> takeNumbers(const std::string& group, const OptionMap& settings,
                                const std::vector<std::string>& wanted);

/// @return the number that a setting holds.
/// @throws std::invalid_argument  naming the setting, its value and what is allowed.
double toNumber(const std::string& name, const OptionValue& value, double min = -1e30, double max = 1e30);

/// Takes settings all of which are texts.
/// @param where  the settings stand, for messages; empty: on top.  @param also  what the caller takes, for the nearest
/// name.
/// @return the texts called `names`, in that order, "" for one that is not there.
/// @throws std::invalid_argument  naming a setting that is unknown or no text.
template <std::size_t N>
std::array<std::string, N> takeTexts(const std::string& where, OptionMap values, const char* const (&names)[N],
                                     const std::vector<std::string>& also = {}) {
  std::array<std::string, N> texts;
  prefixed(where.empty() ? "" : where + ": ", [&] {
    std::vector<OptionDescription> known;
    for (const std::string& name : also) known.push_back({"", name, "", "", "", ""});
    for (std::size_t i = 0; i < N; ++i) {
      known.push_back({"", names[i], "", "", "", ""});
      if (const auto text = values.extract(names[i]))
        option_table::assign({{{}, names[i], "-", "a text", 0.0, 0.0, {}}, &texts[i]}, text.mapped());
    }
    refuseUnknown(values, known);
  });
  return texts;
}

/// @param where  the setting that gives the name, for messages.
/// @throws std::invalid_argument  unless the name is letters, digits and _, a letter first, and not too long: names
/// stand in topics, files, tables, messages and expressions.
void requireName(const std::string& where, const std::string& name);

/// Takes settings all of which a table has.
/// @param where  the settings stand, for messages.
/// @throws std::invalid_argument  as takeOptions() and refuseUnknown().
template <class Options, std::size_t N>
void takeAll(const std::string& where, OptionMap values, const OptionField<Options> (&fields)[N], Options& options) {
  prefixed(where + ": ", [&] {
    takeOptions(values, fields, options);
    refuseUnknown(values, describeOptions(fields));
  });
}

}  // namespace suspension_health_monitor
