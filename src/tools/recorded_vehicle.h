#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <string>
#include <vector>

#include "../ros/vehicle_options.h"
#include "imu_bags.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/vehicle/body_level.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// The vehicle of --vehicle, and which of its struts are asked for.
struct AskedVehicle {
  VehicleLayout layout;
  std::string file;
  std::vector<std::string> names;   ///< of the struts
  std::vector<std::size_t> asked;   ///< their places
  std::optional<std::size_t> only;  ///< place of the strut of --strut
};

/// @throws std::invalid_argument  as readVehicleFile(), for topics of one strut, and for a strut that is none of it.
AskedVehicle readVehicle(const boost::program_options::variables_map& values);

/// @return the topics of all its sensors.
std::vector<std::string> topicsOf(const VehicleStreams& streams);

/// One bag, read as a drive of a vehicle.
struct VehicleBag {
  /// By VehicleLayout::struts z'' at the strut's top and w'', by VehicleLayout::known_forces the forces.
  VehicleDrive drive;
  std::string alignment;  ///< StreamGrid::describeAlignment()
  BodyLevel body_level;
  /// What became of one sensor's messages.
  struct Sensor {
    std::string topic;
    RejectCounts rejected;
    std::uint64_t missed;  ///< readings of others and instants that were lost for want of its readings
  };
  std::vector<Sensor> sensors;  ///< by VehicleStreams::sensors
};

/// The sensors of a vehicle as bags have them.
/// @param bags  whose topics become those of the streams, in their order.
/// @param layout  whose struts with a frame get their position, by the static transforms of the bags.
/// @throws InputError, TooLittleError  as readTopics().
/// @throws std::invalid_argument  if a frame has no static transform.
VehicleStreams streamsOf(ImuBags& bags, const PipelineOptions& options, VehicleLayout& layout);

/// Reads bags as drives of a vehicle, one each: all sensors on one grid, the strut tops told by their own IMUs or by
/// that of the body.
/// @param bags  whose topics are taken from the layout; the static transforms are read if the layout has frames.
/// @param options  without a sample_period it is measured and set.
/// @param layout  as streamsOf(); its positions become those in upright axes, if the body's IMU leans in the first
/// drive.
/// @param gaps  collects the gaps in all that is read.
/// @throws InputError, TooLittleError  as readTopics().
/// @throws std::invalid_argument  if a frame has no static transform.
std::vector<VehicleBag> readVehicleDrives(ImuBags bags, PipelineOptions& options, VehicleLayout& layout,
                                          TopicGaps& gaps);

/// Reads all bags as drives of the vehicle, and tells people what they hold and which topics were silent.
/// @param vehicle  whose struts with a frame get their position.
/// @param options  without a sample_period it is measured and set.
/// @throws InputError, TooLittleError, std::invalid_argument  as readVehicleDrives().
std::vector<VehicleDrive> readDrives(const boost::program_options::variables_map& values, AskedVehicle& vehicle,
                                     PipelineOptions& options, TopicGaps& gaps);

/// @throws TooLittleError  saying why, if the drives do not tell how the struts move one another.
void requireCoupling(const VehicleCoupling& coupling);

/// Tells people what the readings of a vehicle became.
void printReadings(std::size_t num_samples, std::size_t num_struts, const std::string& alignment,
                   const BodyLevel& level);

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
