#pragma once

#include <boost/program_options.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "../ros/vehicle_options.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"
#include "suspension_health_monitor/vehicle.h"
#include "topic_gaps.h"

namespace suspension_health_monitor {

/// The vehicle of --vehicle, and which of its struts are asked for.
struct AskedVehicle {
  VehicleLayout layout;
  std::string file;
  std::vector<std::string> names;   ///< of the struts
  std::vector<std::size_t> asked;   ///< their places
  std::optional<std::size_t> only;  ///< place of the strut of --strut
};

/// Refuses options that have no meaning for a vehicle.
/// @throws std::invalid_argument  naming the option.
void refuseBesideVehicle(const boost::program_options::variables_map& values,
                         std::initializer_list<const char*> options);

/// @throws std::invalid_argument  as readVehicleFile(), for topics of one strut, and for a strut that is none of it.
AskedVehicle readVehicle(const boost::program_options::variables_map& values);

/// @return the topics of all its sensors.
std::vector<std::string> topicsOf(const VehicleStreams& streams);

/// Reads all bags as drives of the vehicle, and tells people what they hold and which topics were silent.
/// @param vehicle  whose struts with a frame get their position.
/// @param options  without a sample_period it is measured and set.
/// @throws InputError, TooLittleError, std::invalid_argument  as readVehicleDrives().
std::vector<VehicleDrive> readDrives(const boost::program_options::variables_map& values, AskedVehicle& vehicle,
                                     PipelineOptions& options, TopicGaps& gaps);

/// Tells people what became of the messages of the sensors that were kept out.
void printRejected(const std::string& topic, const RejectCounts& rejected);

/// @return what identifyVehicle() takes of the settings, by strut.
/// @param settings  with a sample_period.
std::vector<IdentifyOptions> identifyOptionsOf(const VehicleOptions& settings);

/// @return the same of compare() for one strut.
/// @param model  that is judged as it is; nothing: the linear one, fitted.
CompareOptions compareOptionsOf(const PipelineOptions& strut, double sample_period,
                                const std::optional<StrutModel>& model);

/// @return the same of diagnoseVehicle(), by strut.
/// @param options  what is the same for all; gets the sample_period.
std::vector<DiagnoseOptions> diagnoseOptionsOf(const VehicleOptions& settings, DiagnoseOptions& options);

/// @return L, if the settings of a strut give the horizon.
std::optional<int> givenHorizon(const PipelineOptions& strut, double sample_period);

}  // namespace suspension_health_monitor
