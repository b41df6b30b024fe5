#pragma once

#include <boost/program_options.hpp>

namespace suspension_health_monitor {

/// Adds --vehicle and --strut.
void addVehicleOptions(boost::program_options::options_description& description);

/// @return true if a vehicle file is given: the commands below are then meant.
bool isOfVehicle(const boost::program_options::variables_map& values);

/// What the subcommands of these names do for every strut of a vehicle, with the values that they have parsed.
/// @throws std::invalid_argument, InputError, TooLittleError  as command.h.
void identifyStruts(const boost::program_options::variables_map& values);
void compareStruts(const boost::program_options::variables_map& values);
void diagnoseStruts(const boost::program_options::variables_map& values);
void watchStruts(const boost::program_options::variables_map& values);

inline constexpr const char* kBaseline = "baseline";  ///< name of an option

}  // namespace suspension_health_monitor
