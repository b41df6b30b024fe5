#pragma once

#include <string>
#include <vector>

#include "../ros/shell_options.h"  // of its folder the file without ROS

namespace suspension_health_monitor {

// Keywords of a call are a dict in Python, here an OptionMap by the full names of the options.

/// @param keywords  of a call: an option's name, with _ for / where a Python name is wanted: health_damping_warn.
/// @param known  all options that the call understands.
/// @param arguments  its other keywords, for the proposal of a name that is near an unknown one.
/// @return them by full names.
/// @throws std::invalid_argument  naming an unknown name.
OptionMap takeKeywords(const OptionMap& keywords, const std::vector<OptionDescription>& known,
                       const std::vector<std::string>& arguments);

/// The same for all options of a struct.
template <class Options>
OptionMap keywordsOf(const OptionMap& keywords, const std::vector<std::string>& arguments) {
  return takeKeywords(keywords, Options::describe(), arguments);
}

/// @return without those that are about messages, of which arrays have none: axes, frames, ranges, rates, publishing.
OptionMap withoutMessages(OptionMap keywords);

/// @return the options where readings are arrays.
/// @throws std::invalid_argument  naming name, value and what is allowed; also for options of messages and files,
/// which arrays have no use for.
PipelineOptions arrayOptions(const OptionMap& keywords);

}  // namespace suspension_health_monitor
