#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <suspension_health_monitor/CouplingInUse.h>

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_inertia.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"

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
  /// @param monitor  nullptr: none yet, and then why.  @param places  of the struts; empty: not known.
  /// @param stamp  of the newest sample.
  void publish(const VehicleMonitor* monitor, const std::string& why_none, const StrutPlaces& places,
               const ros::Time& stamp);

  /// The task "Coupling".
  void describe(const VehicleMonitor* monitor, const std::string& why_none, const StrutPlaces& places,
                diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  std::vector<std::string> struts_, forces_;
  ros::Publisher publisher_;
  std::optional<CouplingInUse> last_;
};

/// @return why the struts of a vehicle have no monitors of their own, in a sentence.
std::string whyNotCoupled(const VehicleMonitor& monitor, const std::vector<std::string>& struts);

}  // namespace suspension_health_monitor
