#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>

#include <cstddef>
#include <vector>

#include "imu_mount.h"
#include "shell_options.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"

namespace suspension_health_monitor {

/// The sensors of a vehicle: message -> values of the streams of that sensor, of IMUs by their mount. The body's axes
/// are those of the strut in ImuMount: sprung_axis names what points up, of target_frame or of the IMU.
class VehicleSensors {
 public:
  /// @param transforms  as ImuMount.
  VehicleSensors(const VehicleStreams& streams, const ShellOptions& options, const tf2::BufferCore* transforms);

  /// @param sensor  its place in VehicleStreams::sensors.
  /// @return the values of its streams, from VehicleStreams::Sensor::stream on, valid until the next call; none if the
  /// message must be kept out, which rejected() counts.
  const std::vector<double>& read(std::size_t sensor, const sensor_msgs::Imu& message);
  const std::vector<double>& read(std::size_t sensor, const geometry_msgs::WrenchStamped& message);

  const ImuMount& mount(std::size_t sensor) const { return sensors_[sensor].mount; }  ///< of an IMU

  /// @return messages of a sensor that were kept out so far.
  const RejectCounts& rejected(std::size_t sensor) const { return sensors_[sensor].rejected; }

 private:
  struct Sensor {
    VehicleStreams::Place place;
    ImuMount mount;                   // of an IMU
    std::vector<std::size_t> fields;  // of a wrench
    RejectCounts rejected;
  };

  std::vector<Sensor> sensors_;
  std::vector<double> values_;
};

/// Gives struts that have a frame their position, by the static transforms from the body's IMU.
/// @param imu  any message of the body's IMU, which tells its frame.
/// @throws std::invalid_argument  naming the frame whose transform is missing.
void placeFrames(VehicleLayout& layout, const sensor_msgs::Imu& imu, const ShellOptions& options,
                 const tf2::BufferCore& transforms);

}  // namespace suspension_health_monitor
