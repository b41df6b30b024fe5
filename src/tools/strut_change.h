#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../ros/shell_options.h"
#include "suspension_health_monitor/identify.h"

namespace suspension_health_monitor {

/// What `identify` tells of a strut as a whole.
struct StrutOfDrive {
  IdentifiedStrut strut;
  std::string by;        ///< what it was estimated by, in words
  double horizon = 0.0;  ///< of the integral filter [s]
};

/// @return the strut by instrumental variables over the whole drive, else, where that is not valid or not the strut at
/// the end, by LA, else by LS at the end of the drive; nothing: none is valid.
std::optional<StrutOfDrive> strutOf(const IdentifyResult& found);

/// @return how a strut is against the healthy one, in a sentence; empty where no healthy one is known.
std::string describeChange(const StrutOfDrive& strut, const Baseline& healthy, const PipelineOptions& options);

/// @return the same of what was identified; empty also where no estimate is valid.
std::string describeChange(const IdentifyResult& found, const Baseline& healthy, const PipelineOptions& options);

/// Tells people.
/// @param change  nothing is told of an empty one.
void printChange(const std::string& change);

}  // namespace suspension_health_monitor
