#pragma once

#include <boost/program_options.hpp>
#include <map>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {

/// @return why strutOf() cannot be what health is judged by, in words; empty: it can.
std::string whyNotNominal(const IdentifyResult& found, const MonitorOptions& options);

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
