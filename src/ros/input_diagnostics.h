#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <array>
#include <string>
#include <vector>

#include "conversions.h"
#include "imu_pipeline.h"
#include "input_history.h"
#include "shell_options.h"
#include "suspension_health_monitor/internal/signal/silent_sensors.h"

namespace suspension_health_monitor {

/// The task Input of /diagnostics: whether both IMUs deliver, how regularly and how late, and what was kept out.
/// Counters run from the start or the last reset; a warning is about what came since the last report.
class InputDiagnostics {
 public:
  /// @param topics  of the sprung and the unsprung IMU.
  InputDiagnostics(const ShellOptions& options, const std::array<std::string, 2>& topics);

  void noteMessage(Side side, const ros::Time& stamp) {
    arrivals_[indexOf(side)].note(stamp);
    silent_.add(indexOf(side), toStamp(stamp));
  }

  /// @return the topic that is silent while the other goes on, if one is.
  std::vector<std::string> silentTopics() const { return silent_.now(); }

  /// Why the monitor cannot run, once it has found out.
  void setRefusal(const std::string& reason) { refusal_ = reason; }

  /// To be called with a new pipeline: its counters start from 0, and nothing is refused yet.
  void restart();

  void describe(const ImuPipeline& pipeline, diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  void summarize(const ImuPipeline& pipeline, Status& status) const;
  void describeStream(Side side, const ImuPipeline& pipeline, Status& status) const;
  void describeTransforms(const ImuPipeline& pipeline, Status& status) const;

  ShellOptions options_;
  std::array<ImuArrivals, 2> arrivals_;
  SilentSensors silent_;
  PublishedTopics published_;
  std::string refusal_;
  SeriesHistory series_;
  RejectHistory rejected_;
  ClockHistory clock_;
};

}  // namespace suspension_health_monitor
