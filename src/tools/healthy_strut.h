#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <string>
#include <vector>

#include "../ros/vehicle_options.h"
#include "recorded_vehicle.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// The healthy strut as it is given beside the settings.
struct HealthyStrut {
  Baseline baseline;
  std::string file;  ///< that it was read from; empty: none
};

/// @param path  of a file that the monitor has written; or of settings, whose nominal values are taken.
/// @throws std::invalid_argument  naming the file and what is wrong in it.
HealthyStrut readHealthy(const std::string& path);

/// @param given  beside the settings; nothing: that of baseline_file counts, if the file is there.
/// @return the healthy strut, if it is known; nominal values are among the settings.
/// @throws std::invalid_argument  as LiveBaseline, also if nominal values are given beside `given`.
std::optional<HealthyStrut> beforehand(const std::optional<HealthyStrut>& given, const PipelineOptions& options);

/// @return that of --baseline instead of that of baseline_file, if it is given. A live monitor would learn one if the
/// file is not there; that is not what was asked for.
/// @throws std::invalid_argument  as readHealthy() and beforehand().
std::optional<HealthyStrut> healthyOf(const boost::program_options::variables_map& values,
                                      const PipelineOptions& options);

/// The same of the struts of a vehicle, by strut.
std::vector<std::optional<HealthyStrut>> healthyOf(const boost::program_options::variables_map& values,
                                                   const AskedVehicle& vehicle, const VehicleOptions& options);

/// @return the same, else the nominal values, else nothing.
Baseline knownHealthy(const std::optional<HealthyStrut>& given, const PipelineOptions& options);

/// @return by strut of a vehicle how it is against the one known so, as identify says it; empty where none is known.
std::vector<std::string> changesOf(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                   const VehicleOptions& settings);

}  // namespace suspension_health_monitor
