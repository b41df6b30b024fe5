#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/buffer_core.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "shell_options.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/vehicle/gravity.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

namespace suspension_health_monitor {

/// How one IMU sits on the strut: takes the components along and across the strut out of its messages (REP 145).
/// Without a target frame the axes are those of the IMU; with one those of that frame, and a static transform says how
/// the IMU is turned against it. Only the rotation counts; that an IMU sits away from the strut top is what the effect
/// lever_arm is for.
/// Not for two threads at a time. Once the transform is known, it is not looked up again, which would take a lock.
class ImuMount {
 public:
  /// @param axis  one of kAxisNames: what points up along the strut.
  /// @param range  the sensor's range [m/s^2]: readings at its end are clipped.
  /// @param transforms  with a target frame: where the transform is looked up until it is there; outlives this object.
  ImuMount(const std::string& axis, const std::string& target_frame, const std::optional<double>& range,
           const tf2::BufferCore* transforms);

  /// Appends the acceleration along the strut, gravity included as measured [m/s^2]; of an IMU with six axes what it
  /// measures along the strut's, x and y across it, z up: three accelerations [m/s^2], then three angular rates
  /// [rad/s].
  /// @return why there is nothing to append: kNotMeasured (the message says so: covariance -1, sensor_msgs/Imu),
  /// kNoTransform, kClipped.
  std::optional<RejectReason> read(const sensor_msgs::Imu& imu, bool six_axes, std::vector<double>& values);

  /// @return what the IMU measures across the strut; the rates are NaN if the message says that they are not measured.
  /// @pre read() has taken the message.
  BodyMotion across(const sensor_msgs::Imu& imu) const;

  /// @param v  in the IMU's frame.
  /// @return its components along the strut's axes.
  /// @pre read() has found the transform.
  std::array<double, 3> turned(const geometry_msgs::Vector3& v) const;

  /// @return the direction up along the strut, in the IMU's axes.
  const tf2::Vector3& up() const { return directions_[2]; }

  /// @return the frame of the IMU whose transform is missing; empty if none is.
  const std::string& missingTransform() const { return missing_; }

 private:
  bool findTransform(const std::string& frame);
  bool isClipped(const geometry_msgs::Vector3& acceleration) const;

  // Rows are unit vectors: two directions across the strut, then the one up along it,
  tf2::Matrix3x3 axes_{0, 0, 0, 0, 0, 0, 0, 0, 0};  // in the target frame; without one, in the IMU itself
  tf2::Matrix3x3 directions_;                       // in the IMU
  std::string target_frame_;
  std::optional<double> range_;
  const tf2::BufferCore* transforms_;
  std::optional<std::string> frame_;  // of the IMU, whose transform is known
  std::string missing_;
};

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

  /// @return what gravity tells of an IMU against the settings; nothing as long as it tells nothing.
  const std::optional<MountClaim::Finding>& gravityOf(std::size_t sensor) const { return sensors_[sensor].gravity; }

  /// @param names  of sensors, from the first on.
  /// @return by sensor how its gravity contradicts the settings, in a sentence; empty: it does not. Two IMUs of a strut
  /// that lean alike are along an inclined strut.
  std::vector<std::string> mountFaults(const std::vector<std::string>& names) const;

  const VehicleStreams& streams() const { return streams_; }

 private:
  struct Sensor {
    ImuMount mount;  // of an IMU
    RejectCounts rejected;
    MountClaim claim;  // of an IMU
    std::optional<MountClaim::Finding> gravity;
  };

  VehicleStreams streams_;
  std::vector<Sensor> sensors_;
  std::vector<double> values_;
};

/// @throws std::invalid_argument  naming target_frame, if no static transform is of this frame.
void requireFrame(const std::string& target_frame, const tf2::BufferCore& transforms);

/// @return the streams, of which everything is known but the places of struts that have a frame.
VehicleStreams streamsAnywhere(VehicleLayout layout);

/// Gives struts that have a frame their position, by the static transforms from the body's IMU.
/// @param imu  any message of the body's IMU, which tells its frame.
/// @throws std::invalid_argument  naming the frame whose transform is missing, or two struts in one place.
void placeFrames(VehicleLayout& layout, const sensor_msgs::Imu& imu, const ShellOptions& options,
                 const tf2::BufferCore& transforms);

}  // namespace suspension_health_monitor
