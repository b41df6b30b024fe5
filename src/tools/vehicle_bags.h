#pragma once

#include <string>
#include <vector>

#include "../ros/shell_options.h"
#include "imu_bags.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/vehicle/body_level.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

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
/// @param gaps  is told of all that is read.
/// @throws InputError, TooLittleError  as readTopics().
/// @throws std::invalid_argument  if a frame has no static transform.
std::vector<VehicleBag> readVehicleDrives(ImuBags bags, PipelineOptions& options, VehicleLayout& layout,
                                          TopicGaps& gaps);

}  // namespace suspension_health_monitor
