#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <string>
#include <vector>

#include "recorded_vehicle.h"
#include "suspension_health_monitor/effects.h"
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

}  // namespace suspension_health_monitor
