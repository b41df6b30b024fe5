#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <array>
#include <optional>
#include <string>

#include "imu_pipeline.h"

namespace suspension_health_monitor {

/// What /diagnostics says of one strut: one task for the input, one for the strut's health.
class MonitorDiagnostics {
 public:
  /// @param imu  the two subscriptions, for their topic names.
  MonitorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name,
                     const ShellOptions& options, const std::array<ros::Subscriber, 2>& imu);

  void noteMessage(Side side) { last_message_[static_cast<std::size_t>(side)] = ros::WallTime::now(); }

  /// @return true if the level differs from the last one: a change is published at once.
  bool noteLevel(HealthLevel level);

  /// Why the monitor cannot run, once it has found out.
  void setRefusal(const std::string& reason) { refusal_ = reason; }

  /// To be called with a new pipeline: its counters start from 0, and nothing is refused yet.
  void restart();

  void publish(const ImuPipeline& pipeline);

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  void describeInput(Status& status);
  void describeHealth(Status& status);
  void describeSilence(Status& status) const;

  ShellOptions options_;
  std::array<std::string, 2> topics_;
  std::array<std::optional<ros::WallTime>, 2> last_message_;
  std::optional<HealthLevel> level_;
  std::string refusal_;
  RejectCounts rejected_before_;
  std::uint64_t gaps_before_ = 0;
  const ImuPipeline* pipeline_ = nullptr;  // during publish() only
  diagnostic_updater::Updater updater_;
};

}  // namespace suspension_health_monitor
