#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

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
