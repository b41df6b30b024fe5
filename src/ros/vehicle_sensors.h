#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>

#include <cstddef>
#include <string>
#include <vector>

#include "imu_mount.h"
#include "shell_options.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"

namespace suspension_health_monitor {

/// The IMUs of a vehicle: message -> values of the streams of that IMU, by its mount. The body's axes are those of the
/// strut in ImuMount: sprung_axis names what points up, of target_frame or of the IMU.
class VehicleSensors {
 public:
  /// @param transforms  as ImuMount.
  VehicleSensors(const VehicleStreams& streams, const ShellOptions& options, const tf2::BufferCore* transforms);

  /// @param imu  its place in VehicleStreams::imus.
  /// @return the values of its streams, from VehicleStreams::Imu::stream on, valid until the next call; none if the
  /// message must be kept out, which rejected() counts.
  const std::vector<double>& read(std::size_t imu, const sensor_msgs::Imu& message);

  /// @return messages of an IMU that were kept out so far.
  const RejectCounts& rejected(std::size_t imu) const { return imus_[imu].rejected; }

 private:
  struct Imu {
    VehicleStreams::Place place;
    ImuMount mount;
    RejectCounts rejected;
  };

  std::vector<Imu> imus_;
  std::vector<double> values_;
};

/// Gives struts that have a frame their position, by the static transforms from the body's IMU.
/// @param imu  any message of the body's IMU, which tells its frame.
/// @throws std::invalid_argument  naming the frame whose transform is missing.
void placeFrames(VehicleLayout& layout, const sensor_msgs::Imu& imu, const ShellOptions& options,
                 const tf2::BufferCore& transforms);

}  // namespace suspension_health_monitor
