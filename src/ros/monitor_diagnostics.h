#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "imu_pipeline.h"
#include "input_diagnostics.h"
#include "live_model.h"

namespace suspension_health_monitor {

/// What /diagnostics says of one strut: a task each for the input, the strut's health, and the model.
class MonitorDiagnostics {
 public:
  /// @param imu  the two subscriptions, for their topic names.  @param model  outlives this object.
  MonitorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name,
                     const PipelineOptions& options, const std::array<ros::Subscriber, 2>& imu, const LiveModel& model);

  InputDiagnostics& input() { return input_; }

  /// @return true if the level differs from the last one: a change is published at once.
  bool noteLevel(HealthLevel level);

  void publish(const ImuPipeline& pipeline);

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// When a reading was accepted last, as seen from the reports.
  struct Accepted {
    std::uint64_t samples = 0;
    ros::Time at;
  };

  void describeHealth(Status& status);
  void describeSilence(const SuspensionMonitor& monitor, Status& status);
  void describeModel(Status& status);
  void describeDiagnosis(Status& status) const;

  double input_timeout_;  // [s]
  Accepted accepted_;
  InputDiagnostics input_;
  const LiveModel& model_;
  std::optional<HealthLevel> level_;
  const ImuPipeline* pipeline_ = nullptr;  // during publish() only
  diagnostic_updater::Updater updater_;
};

}  // namespace suspension_health_monitor
