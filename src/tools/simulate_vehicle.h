#pragma once

#include <boost/program_options.hpp>
#include <string>

#include "../ros/simulated_drive.h"
#include "suspension_health_monitor/internal/option_table.h"

namespace suspension_health_monitor {

/// `simulate --vehicle-model`: writes the bag, the vehicle's file if asked, and what the truth is.
/// @param settings  by --config and --set and flags, without the model.
void simulateVehicle(const boost::program_options::variables_map& values, const std::string& model, OptionMap settings);

/// Writes a whole simulated drive, with progress.
void writeBag(const SimulatedDrive& drive, const std::string& path);

}  // namespace suspension_health_monitor
