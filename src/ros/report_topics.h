#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shell_options.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// What is published of every sample: ~estimate, ~ls, ~la, ~comparison, ~health; and what the model is, when it
/// changes: the latched topic ~model.
class ReportTopics {
 public:
  static constexpr std::uint32_t kQueueSize = 100000;  // messages

  ReportTopics(ros::NodeHandle& private_node, const PipelineOptions& options);

  /// Publishes what has subscribers, of every publish_every-th report.
  /// @param frame  frame_id of the body's IMU.
  void publish(const MonitorReport& report, const SuspensionMonitor& monitor, const std::string& frame);

  /// @param every  so many reports make one publication, >= 1.
  void setStride(int every) { stride_ = static_cast<std::uint64_t>(every); }

  /// The model is another one from now on.
  /// @param monitor  nullptr as long as the sample period is being measured.
  void changeModel(const std::vector<ActiveEffect>& effects, const SuspensionMonitor* monitor,
                   const std::string& frame);

 private:
  std::uint64_t stride_ = 1, reports_ = 0;
  std::optional<double> sprung_mass_;  // [kg]
  ros::Publisher estimate_, ls_, la_, comparison_, health_, model_;
  bool model_has_estimate_ = false;
};

}  // namespace suspension_health_monitor
