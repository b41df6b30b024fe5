#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>

#include "shell_options.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"

namespace suspension_health_monitor {

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
