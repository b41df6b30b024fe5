#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <array>
#include <optional>
#include <string>

#include "imu_pipeline.h"
#include "shell_options.h"

namespace suspension_health_monitor {

/// The task Input of /diagnostics: whether both IMUs deliver, how regularly and how late, and what was kept out.
/// Counters run from the start or the last reset; a warning is about what came since the last report.
class InputDiagnostics {
 public:
  /// @param imu  the two subscriptions, for their topic names.
  InputDiagnostics(const ShellOptions& options, const std::array<ros::Subscriber, 2>& imu);

  void noteMessage(Side side, const ros::Time& stamp);

  /// Why the monitor cannot run, once it has found out.
  void setRefusal(const std::string& reason) { refusal_ = reason; }

  /// To be called with a new pipeline: its counters start from 0, and nothing is refused yet.
  void restart();

  void describe(const ImuPipeline& pipeline, diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// When the messages of one IMU came.
  struct Arrivals {
    ros::Time last;
    ros::WallTime last_by_wall;
    RunningMean lag{0.99};  // time of arrival - stamp [s]
  };

  void summarize(const ImuPipeline& pipeline, Status& status) const;
  bool isSilentByWall() const;
  void describeSeries(const SuspensionMonitor& monitor, Status& status);
  void describeStream(Side side, const ImuPipeline& pipeline, Status& status) const;
  void describeRejected(const RejectCounts& rejected, Status& status);
  void describeTransforms(const ImuPipeline& pipeline, Status& status) const;
  void describeSilence(Status& status) const;
  void describeClock(Status& status);

  ShellOptions options_;
  std::array<std::string, 2> topics_;
  std::array<std::optional<Arrivals>, 2> arrivals_;
  std::string refusal_;
  RejectCounts rejected_before_;
  std::uint64_t gaps_before_ = 0;
  std::optional<ros::Time> clock_before_;
};

}  // namespace suspension_health_monitor
