#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <suspension_health_monitor/CouplingInUse.h>

#include <optional>
#include <string>
#include <vector>

#include "monitor_host.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/monitor/vehicle_monitor.h"
#include "suspension_health_monitor/vehicle.h"
#include "task_log.h"
#include "vehicle_options.h"

namespace suspension_health_monitor {

/// The four corners of a vehicle against each other: the latched topic corners/comparison and a task of /diagnostics.
class CornerOutput {
 public:
  CornerOutput(ros::NodeHandle& node, const CornerPlaces& places);

  /// Judges the corners and publishes the newest verdict that two judgements in a row agreed on.
  /// @param pipeline  nullptr: none yet.
  void publish(const MessagePipeline* pipeline);

  /// The task "Corners".
  void describe(Status& status) const;

 private:
  CornerComparisonReport judge(const MessagePipeline* pipeline);

  CornerPlaces places_;  // of the corners among the struts
  ros::Publisher publisher_;
  Stamp newest_{};  // sample at the last judgement
  CornerComparisonReport last_ = compareCorners({}), confirmed_ = last_;
};

/// What a live vehicle says as a whole: the tasks Coupling, Input and, with four corners, Corners of /diagnostics; how
/// the struts move one another as the latched topic ~coupling; and corners/comparison.
class VehicleDiagnostics {
 public:
  /// @param host  outlives this object.
  VehicleDiagnostics(MonitorHost& host, ros::NodeHandle& node, ros::NodeHandle& private_node, const std::string& name,
                     const VehicleOptions& options);

  void publish();

 private:
  const VehicleMonitor* monitor() const { return host_.pipeline() != nullptr ? host_.pipeline()->monitor() : nullptr; }
  VehicleCoupling coupling() const;
  void publishCoupling();
  void describeCoupling(Status& status) const;

  MonitorHost& host_;
  std::vector<std::string> struts_, forces_;  // their names
  ros::Publisher diagnostics_;                // of all updaters, also of those of the struts
  ros::Publisher coupling_;
  std::optional<CouplingInUse> last_coupling_;  // that was published
  TaskLog coupling_log_;
  std::optional<CornerOutput> corners_;
  diagnostic_updater::Updater updater_;
};

}  // namespace suspension_health_monitor
