#pragma once

#include <map>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/option_table.h"
#include "suspension_health_monitor/internal/prefixed.h"

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

/// @param where  the setting that gives the name, for messages.
/// @throws std::invalid_argument  unless the name is letters, digits and _, a letter first, and not too long: names
/// stand in topics, files, tables, messages and expressions.
void requireName(const std::string& where, const std::string& name);

/// Takes settings all of which a table has.
/// @param where  the settings stand, for messages.  @param also  what the caller takes, for the nearest name.
/// @throws std::invalid_argument  as takeOptions() and refuseUnknown().
template <class Options, std::size_t N>
void takeAll(const std::string& where, OptionMap values, const OptionField<Options> (&fields)[N], Options& options,
             const std::vector<OptionDescription>& also = {}) {
  prefixed(where + ": ", [&] {
    std::vector<OptionDescription> known = describeOptions(fields);
    known.insert(known.end(), also.begin(), also.end());
    takeOptions(values, fields, options);
    refuseUnknown(values, known);
  });
}

}  // namespace suspension_health_monitor
