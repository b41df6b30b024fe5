#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <array>
#include <optional>
#include <string>

#include "imu_pipeline.h"
#include "live_model.h"

namespace suspension_health_monitor {

/// What /diagnostics says of one strut: a task each for the input, the strut's health, and the model.
class MonitorDiagnostics {
 public:
  /// @param imu  the two subscriptions, for their topic names.  @param model  outlives this object.
  MonitorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name,
                     const ShellOptions& options, const std::array<ros::Subscriber, 2>& imu,
                     const LiveModel& model);

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
  void describeModel(Status& status);
  void describeDiagnosis(Status& status) const;
  void describeSilence(Status& status) const;

  ShellOptions options_;
  const LiveModel& model_;
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
