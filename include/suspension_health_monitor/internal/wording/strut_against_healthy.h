#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/monitor_options.h"

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

/// @return the nominal values among the options.
Baseline nominalOf(const MonitorOptions& options);

/// @param options  whose payload_range counts.
/// @return how a strut is against the healthy one, in a sentence; empty where no healthy one is known.
std::string describeChange(const StrutOfDrive& strut, const Baseline& healthy, const MonitorOptions& options);

/// @return the same of what was identified; empty also where no estimate is valid.
std::string describeChange(const IdentifyResult& found, const Baseline& healthy, const MonitorOptions& options);

/// @return the same of drives that were searched for effects.
std::string describeChange(const std::vector<Drive>& drives, const DiagnoseOptions& searched, const Baseline& healthy,
                           const MonitorOptions& options);

}  // namespace suspension_health_monitor
