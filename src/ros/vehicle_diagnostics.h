#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corner_output.h"
#include "coupling_output.h"
#include "message_pipeline.h"
#include "task_log.h"
#include "vehicle_options.h"
#include "vehicle_sensors.h"

namespace suspension_health_monitor {

/// What a live vehicle says as a whole: the tasks Coupling, Input and, with four corners, Corners of /diagnostics,
/// ~coupling and corners/comparison.
class VehicleDiagnostics {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// @param placement  outlives this object.
  VehicleDiagnostics(ros::NodeHandle& node, ros::NodeHandle& private_node, const std::string& name,
                     const VehicleOptions& options, const VehiclePlacement& placement,
                     const std::function<void(Status&)>& describe_input);

  /// @param pipeline  nullptr: none, as the struts have no places yet.
  void publish(const MessagePipeline* pipeline);

  /// @return why the struts have no monitors.
  std::string whyNoMonitor(const MessagePipeline* pipeline) const;

 private:
  const VehiclePlacement& placement_;
  std::vector<std::string> struts_;  // their names
  ros::Publisher publisher_;         // of all updaters, also of those of the struts
  TaskLog coupling_log_;
  CouplingOutput coupling_;
  std::optional<CornerOutput> corners_;
  const MessagePipeline* pipeline_ = nullptr;  // during publish() only
  diagnostic_updater::Updater updater_;
};

}  // namespace suspension_health_monitor
