#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <optional>
#include <string>

#include "model_topic.h"
#include "tyre_output.h"

namespace suspension_health_monitor {

/// What is told of every sample: ~estimate, ~ls, ~la, ~comparison, ~health and those of the tyre; and ~model, when it
/// changes.
class ReportTopics {
 public:
  static constexpr std::uint32_t kQueueSize = 100000;  // messages

  ReportTopics(ros::NodeHandle& private_node, const PipelineOptions& options);

  /// Publishes what has subscribers, of every publish_every-th report.
  /// @param tyre  nullptr: no road sensor.  @param frame  frame_id of the body's IMU.
  void publish(const MonitorReport& report, const SuspensionMonitor& monitor, const TyreTracker* tyre,
               const std::string& frame);

  /// @param every  so many reports make one publication, >= 1.
  void setStride(int every) { stride_ = static_cast<std::uint64_t>(every); }

  ModelTopic& model() { return model_; }

 private:
  std::uint64_t stride_ = 1, reports_ = 0;
  std::optional<double> sprung_mass_;  // [kg]
  ros::Publisher estimate_, ls_, la_, comparison_, health_;
  ModelTopic model_;
  std::optional<TyreOutput> tyre_;
};

}  // namespace suspension_health_monitor
