#pragma once

#include <boost/program_options.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "recorded_vehicle.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

// Files that hold something of every strut, `struts: {NAME: {...}}`; with --strut they may hold that of the one strut
// alone, as the commands have it without --vehicle.

/// Reads --model.
/// @return by strut; nothing of a strut that the file does not have.
/// @throws std::invalid_argument  naming the file and what is wrong in it.
KnownModels readModels(const boost::program_options::variables_map& values, const AskedVehicle& vehicle,
                       const EffectLibrary& library);

/// Reads a file of healthy struts, likewise.
std::vector<std::optional<Baseline>> readBaselines(const std::string& path, const AskedVehicle& vehicle);

/// @param models  by strut.
/// @return the text of the file that readModels() takes: of all struts that have a model, or that of --strut alone.
std::string toYaml(const KnownModels& models, const AskedVehicle& vehicle);

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
