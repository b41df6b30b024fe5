#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

// Files that hold something of every strut, `struts: {NAME: {...}}`; with --strut they may hold that of the one strut
// alone, as the commands have it without --vehicle.

/// Reads --model.
/// @return by strut; nothing of a strut that the file does not have.
/// @throws std::invalid_argument  naming the file and what is wrong in it.
KnownModels readModels(const po::variables_map& values, const AskedVehicle& vehicle, const EffectLibrary& library);

/// @return why strutOf() cannot be what health is judged by, in words; empty: it can.
std::string whyNotNominal(const IdentifyResult& found, const MonitorOptions& options);

/// The text of a file of settings, as the monitor loads it and --config: those that were given, the horizon, and the
/// strut as the nominal one; of a vehicle its struts by name: `struts: {NAME: {...}}`.
/// @param is_of_one  the file is to be that of the one strut: with the settings of all, before which its own come.
/// @param drives  names of the bags.
std::string settingsOf(const std::map<std::string, StrutOfDrive>& struts, bool is_of_one, OptionMap given,
                       const std::vector<std::string>& drives);

/// The healthy strut as it is given beside the settings.
struct HealthyStrut {
  Baseline baseline;
  std::string file;  ///< that it was read from; empty: none
};

/// @param path  of a file that the monitor has written of one strut; or of settings, whose nominal values are taken.
/// @throws std::invalid_argument  naming the file and what is wrong in it.
Baseline readHealthy(const std::string& path);

/// For every strut the baseline that is known before the bags are read, if there is one. Nominal values are not here:
/// they are among the settings.
using HealthyStruts = std::vector<std::optional<HealthyStrut>>;

/// @param given  by strut, or empty. A strut without one gets that of its baseline_file, if the file is there.
/// @throws std::invalid_argument  as LiveBaseline, also if nominal values are given beside `given`.
HealthyStruts beforehand(HealthyStruts given, const BagOptions& options);

/// @return beforehand() with what --baseline gives, if it is given. The file must be there, unlike baseline_file of a
/// live monitor, which learns a baseline where the file is missing.
/// @throws std::invalid_argument  likewise, and naming the file and what is wrong in it.
HealthyStruts healthyOf(const po::variables_map& values, const BagOptions& options);

/// @return what is known of a strut beforehand, else the nominal values, else nothing.
Baseline knownHealthy(const std::optional<HealthyStrut>& healthy, const PipelineOptions& options);

}  // namespace suspension_health_monitor
