#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <suspension_health_monitor/CouplingInUse.h>

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What a vehicle's monitor knows of how the struts move one another: the latched topic ~coupling and a task of
/// /diagnostics.
class CouplingOutput {
 public:
  /// @param struts, forces  their names.
  CouplingOutput(ros::NodeHandle& private_node, const std::vector<std::string>& struts,
                 const std::vector<std::string>& forces)
      : struts_(struts), forces_(forces), publisher_(private_node.advertise<CouplingInUse>("coupling", 1, true)) {}

  /// Publishes what is known, if it is not what was published last.
  /// @param monitor  nullptr: none yet, and then why.  @param stamp  of the newest sample.
  void publish(const VehicleMonitor* monitor, const std::string& why_none, const ros::Time& stamp);

  /// The task "Coupling".
  void describe(const VehicleMonitor* monitor, const std::string& why_none,
                diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  VehicleCoupling known(const VehicleMonitor* monitor, const std::string& why_none) const;

  std::vector<std::string> struts_, forces_;
  ros::Publisher publisher_;
  std::optional<CouplingInUse> last_;
};

}  // namespace suspension_health_monitor
