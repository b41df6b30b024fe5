#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "shell_options.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {

/// @return the frame's name without the slash that some drivers still put in front of it, as tf1 did: tf2 does not find
/// such a name.
std::string withoutSlash(const std::string& frame);

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

  /// The mounts of sprung and unsprung IMU.
  static std::array<ImuMount, kMostStreams> of(const ShellOptions& options, const tf2::BufferCore* transforms);

  /// Appends the acceleration along the strut, gravity included as measured [m/s^2]; of an IMU with six axes what it
  /// measures along the strut's, x and y across it, z up: three accelerations [m/s^2], then three angular rates
  /// [rad/s].
  /// @return why there is nothing to append: kNotMeasured (the message says so: covariance -1, sensor_msgs/Imu),
  /// kNoTransform, kClipped.
  std::optional<RejectReason> read(const sensor_msgs::Imu& imu, bool six_axes, std::vector<double>& values);

  /// @return what the IMU measures across the strut; NaN what it says it does not measure.
  /// @pre read() has found the transform.
  BodyMotion across(const sensor_msgs::Imu& imu) const;

  /// @param v  in the IMU's frame.
  /// @return its components along the strut's axes.
  /// @pre as across().
  std::array<double, 3> turned(const geometry_msgs::Vector3& v) const;

  /// @return the direction up along the strut, in the IMU's axes.
  const std::array<double, 3>& up() const { return directions_[2]; }

  /// @return the frame of the IMU whose transform is missing; empty if none is.
  const std::string& missingTransform() const { return missing_; }

 private:
  /// A direction of the strut in the IMU's axes: a unit vector.
  using Direction = std::array<double, 3>;

  bool findTransform(const std::string& frame);
  bool isClipped(const geometry_msgs::Vector3& acceleration) const;

  // Two directions across the strut and the one up along it:
  std::array<Direction, 3> axes_;        // in the target frame; without one, in the IMU itself
  std::array<Direction, 3> directions_;  // in the IMU
  std::string target_frame_;
  std::optional<double> range_;
  const tf2::BufferCore* transforms_;
  std::optional<std::string> frame_;  // of the IMU, whose transform is known
  std::string missing_;
};

}  // namespace suspension_health_monitor
