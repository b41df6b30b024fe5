#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "suspension_health_monitor/vehicle.h"

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

/// @return true for a strut alone, which has no name and nothing that it is to be separated from.
inline bool isOneStrut(const std::vector<std::string>& names) { return names.size() == 1 && names.front().empty(); }

/// @throws std::invalid_argument  if a drive has another number of struts.
inline std::vector<Drive> drivesOfOne(const std::vector<VehicleDrive>& drives) {
  std::vector<Drive> own;
  for (const VehicleDrive& drive : drives) {
    if (drive.struts.size() != 1) throw std::invalid_argument("a drive of more than one strut, must be of one");
    own.push_back(drive.struts.front());
  }
  return own;
}

}  // namespace suspension_health_monitor
