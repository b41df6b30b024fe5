#pragma once

#include <boost/program_options.hpp>

#include "suspension_health_monitor/internal/option_table.h"

namespace suspension_health_monitor {

/// `simulate --vehicle-model`: writes the bag, the vehicle's file if asked, and what the truth is.
/// @param settings  by --config and --set and flags.
void simulateVehicle(const boost::program_options::variables_map& values, OptionMap settings);

}  // namespace suspension_health_monitor
