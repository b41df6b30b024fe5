#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include "imu_pipeline.h"

namespace suspension_health_monitor {

/// What a monitor with a third IMU on the road says of wheel and tyre: ~tyre_ls, ~tyre_la and a task of /diagnostics.
class TyreOutput {
 public:
  TyreOutput(ros::NodeHandle& private_node, std::uint32_t queue_size);

  /// Publishes what has subscribers.
  void publish(const TyreTracker& tracker, const StrutEstimate& strut, const std_msgs::Header& header);

 private:
  ros::Publisher ls_, la_;
};

/// The task "Tyre".
void describeTyre(const ImuPipeline& pipeline, diagnostic_updater::DiagnosticStatusWrapper& status);

}  // namespace suspension_health_monitor
