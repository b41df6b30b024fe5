#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace suspension_health_monitor {

/// @param options  by strut, or one that is meant for all, or none: the defaults.
/// @return by strut.
/// @throws std::invalid_argument  if they are of another number of struts.
template <class Options>
std::vector<Options> optionsByStrut(const std::vector<Options>& options, std::size_t num_struts) {
  if (options.empty()) return std::vector<Options>(num_struts);
  if (options.size() == 1) return std::vector<Options>(num_struts, options.front());
  if (options.size() != num_struts)
    throw std::invalid_argument("options of " + std::to_string(options.size()) + " struts, must be of " +
                                std::to_string(num_struts) + ", or one for all");
  return options;
}

/// @return that of the vehicle, if it is given.
template <class Options>
std::optional<double> samplePeriodOf(const std::vector<Options>& options) {
  return options.empty() ? std::nullopt : options.front().sample_period;
}

}  // namespace suspension_health_monitor
