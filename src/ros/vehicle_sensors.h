#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "imu_mount.h"
#include "shell_options.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

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

/// Where the struts of a live vehicle stand: as its file says, or by static transforms from the frame of the body's
/// IMU, which only its messages tell.
class VehiclePlacement {
 public:
  explicit VehiclePlacement(const VehicleLayout& layout);

  /// Takes in a message of the body's IMU.
  void noteBody(const sensor_msgs::Imu& message) { body_message_ = message; }

  /// @return the streams with the struts in their places; none as long as a frame has not been found: missing().
  std::optional<VehicleStreams> find(const ShellOptions& options, const tf2::BufferCore& transforms);

  /// @return the streams, of which everything but the places is known from the start.
  const VehicleStreams& streams() const { return streams_; }

  /// @return why there are no places yet.
  const std::string& missing() const { return missing_; }

 private:
  VehicleLayout layout_;
  VehicleStreams streams_;
  std::optional<sensor_msgs::Imu> body_message_;
  std::string missing_ = "waiting for body_imu, whose frame tells the struts' positions";
};

}  // namespace suspension_health_monitor
