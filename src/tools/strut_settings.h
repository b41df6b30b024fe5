#pragma once

#include <boost/program_options.hpp>
#include <map>
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

/// @return why that strut cannot be what health is judged by, in words; empty: it can.
std::string whyNotNominal(const IdentifyResult& found, const MonitorOptions& options);

/// Says in a sentence how a strut is against the healthy one; nothing where no healthy one is known.
void printChange(const StrutOfDrive& strut, const Baseline& healthy, const PipelineOptions& options);

/// @return the settings of one strut of a vehicle: those of all, and its own below struts/NAME, which come before them.
OptionMap settingsFor(const std::string& strut, OptionMap given);

/// The text of a file of settings, as the monitor loads it and --config: those that were given, the horizon, and the
/// strut as the nominal one.
/// @param drives  names of the bags.
std::string settingsOf(const StrutOfDrive& strut, const OptionMap& given, const std::vector<std::string>& drives);

/// The same of a vehicle's struts, by name: `struts: {NAME: {...}}`. Those that were given of a strut alone stay with
/// it.
std::string settingsOf(const std::map<std::string, StrutOfDrive>& struts, const OptionMap& given,
                       const std::vector<std::string>& drives);

}  // namespace suspension_health_monitor
