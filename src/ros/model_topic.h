#pragma once

#include <ros/ros.h>
#include <suspension_health_monitor/ModelInUse.h>

#include <string>
#include <vector>

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

}  // namespace suspension_health_monitor
