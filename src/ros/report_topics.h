#pragma once

#include <ros/ros.h>
#include <suspension_health_monitor/ModelInUse.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shell_options.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// The latched topic ~model: what the model is, published when it changes.
class ModelTopic {
 public:
  explicit ModelTopic(ros::NodeHandle& private_node)
      : publisher_(private_node.advertise<ModelInUse>("model", 1, true)) {}

  /// The model is another one from now on.
  /// @param monitor  nullptr as long as the sample period is being measured.
  void change(const std::vector<ActiveEffect>& effects, const SuspensionMonitor* monitor, const std::string& frame);

  /// To be called with every report: publishes the first valid estimate of a model.
  void note(const SuspensionMonitor& monitor, const std::string& frame) {
    if (!has_estimate_ && monitor.modelEstimate().valid()) change(monitor.effects(), &monitor, frame);
  }

 private:
  ros::Publisher publisher_;
  bool has_estimate_ = false;
};

/// What is published of every sample: ~estimate, ~ls, ~la, ~comparison, ~health; and ~model, when it changes.
class ReportTopics {
 public:
  static constexpr std::uint32_t kQueueSize = 100000;  // messages

  ReportTopics(ros::NodeHandle& private_node, const PipelineOptions& options);

  /// Publishes what has subscribers, of every publish_every-th report.
  /// @param frame  frame_id of the body's IMU.
  void publish(const MonitorReport& report, const SuspensionMonitor& monitor, const std::string& frame);

  /// @param every  so many reports make one publication, >= 1.
  void setStride(int every) { stride_ = static_cast<std::uint64_t>(every); }

  ModelTopic& model() { return model_; }

 private:
  std::uint64_t stride_ = 1, reports_ = 0;
  std::optional<double> sprung_mass_;  // [kg]
  ros::Publisher estimate_, ls_, la_, comparison_, health_;
  ModelTopic model_;
};

}  // namespace suspension_health_monitor
