#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>

#include <array>
#include <optional>

#include "imu_mount.h"
#include "shell_options.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"

namespace suspension_health_monitor {

/// The IMUs of one strut, the same live and for every subcommand: message -> acceleration along the strut, by the IMU's
/// mount.
class StrutSensors {
 public:
  /// @param transforms  with a target_frame: where those of the IMUs are looked up; outlives this object.
  StrutSensors(const ShellOptions& options, const tf2::BufferCore* transforms)
      : mounts_(ImuMount::of(options, transforms)) {}

  /// @return the acceleration along the strut, gravity included as measured [m/s^2]; nothing if the message must be
  /// kept out, which rejected() counts.
  std::optional<double> read(Side side, const sensor_msgs::Imu& imu);

  /// @return what the body's IMU measures across the strut in a message that held a reading.
  BodyMotion across(const sensor_msgs::Imu& imu) const { return mounts_[0].across(imu); }

  const ImuMount& mount(Side side) const { return mounts_[static_cast<std::size_t>(side)]; }

  /// @return messages that were kept out so far.
  const RejectCounts& rejected() const { return rejected_; }

 private:
  std::array<ImuMount, kMostStreams> mounts_;
  RejectCounts rejected_;
};

}  // namespace suspension_health_monitor
