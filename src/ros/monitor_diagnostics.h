#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <array>
#include <string>

#include "imu_pipeline.h"
#include "input_diagnostics.h"
#include "live_model.h"
#include "strut_diagnostics.h"

namespace suspension_health_monitor {

/// What /diagnostics says of one strut: a task each for the input, the strut's health, and the model.
class MonitorDiagnostics {
 public:
  /// @param topics  of the sprung and the unsprung IMU.  @param model  outlives this object.
  MonitorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name,
                     const PipelineOptions& options, const std::array<std::string, 2>& topics, const LiveModel& model);

  InputDiagnostics& input() { return input_; }

  /// As StrutDiagnostics has it.
  bool note(const MonitorReport& report) { return strut_.note(report); }

  void publish(const ImuPipeline& pipeline);

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  InputDiagnostics input_;
  TaskLog input_log_;
  StrutDiagnostics strut_;
  const ImuPipeline* pipeline_ = nullptr;  // during publish() only
  diagnostic_updater::Updater updater_;
};

}  // namespace suspension_health_monitor
