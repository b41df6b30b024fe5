#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>

#include <array>
#include <optional>

#include "imu_mount.h"
#include "shell_options.h"
#include "suspension_health_monitor/internal/signal/uniform_grid.h"

namespace suspension_health_monitor {

/// The IMUs of one strut, from messages to samples, the same live and for every subcommand:
/// message -> acceleration along the strut, by the IMU's mount -> UniformGrid -> sample.
class StrutSensors {
 public:
  /// What one message tells along the strut.
  struct Reading {
    Side side;
    Stamp stamp;
    double acceleration;  ///< gravity included as measured [m/s^2]
  };

  /// @param transforms  with a target_frame: where those of the IMUs are looked up; outlives this object.
  StrutSensors(const ShellOptions& options, const tf2::BufferCore* transforms)
      : mounts_(ImuMount::of(options, transforms)) {}

  /// @return the reading in a message; nothing if it must be kept out, which rejected() counts.
  std::optional<Reading> read(Side side, const sensor_msgs::Imu& imu);

  /// @return what the body's IMU measures across the strut in a message that held a reading.
  BodyMotion across(const sensor_msgs::Imu& imu) const { return mounts_[0].across(imu); }

  /// Has readings become samples from now on.
  /// @param period  sampling time [s].
  void start(const PipelineOptions& options, double period) { grid_.emplace(period, options.grid(period)); }

  /// @pre start().
  /// @return as UniformGrid::push(); more by next().
  std::optional<CornerSample> push(const Reading& reading) {
    return grid_->push(reading.side, reading.stamp, reading.acceleration);
  }
  std::optional<CornerSample> next() { return grid_->next(); }

  const ImuMount& mount(Side side) const { return mounts_[static_cast<std::size_t>(side)]; }

  /// @return what makes samples of the readings; nullptr before start().
  const UniformGrid* grid() const { return grid_ ? &*grid_ : nullptr; }

  /// @return messages and readings that were kept out so far.
  RejectCounts rejected() const;

 private:
  std::array<ImuMount, kMostStreams> mounts_;
  std::optional<UniformGrid> grid_;
  RejectCounts rejected_;  // by the mounts
};

}  // namespace suspension_health_monitor
