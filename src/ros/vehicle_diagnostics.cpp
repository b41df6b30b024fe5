#include "vehicle_diagnostics.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include "conversions.h"
#include "strut_diagnostics.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

const VehicleMonitor* monitorOf(const MessagePipeline* pipeline) {
  return pipeline != nullptr ? pipeline->monitor() : nullptr;
}

}  // namespace

// Who advertises first decides how long the queue is: an Updater's own holds one message, and all of them publish at
// once, so that the status of a strut would be lost behind that of the next.
VehicleDiagnostics::VehicleDiagnostics(ros::NodeHandle& node, ros::NodeHandle& private_node, const std::string& name,
                                       const VehicleOptions& options, const VehiclePlacement& placement,
                                       const std::function<void(Status&)>& describe_input)
    : placement_(placement),
      struts_(options.strutNames()),
      publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 2 * (struts_.size() + 1))),
      coupling_log_(name + " coupling"),
      coupling_(private_node, struts_, options.forceNames()),
      corners_(CornerOutput::of(node, struts_)),
      updater_(node, private_node, name) {
  updater_.setHardwareID(name.substr(name.find_first_not_of('/')));
  updater_.add("Coupling", [this](Status& status) {
    coupling_.describe(monitorOf(pipeline_), whyNoMonitor(pipeline_), status);
    coupling_log_.note(status);
  });
  updater_.add("Input", describe_input);
  if (corners_) updater_.add("Corners", [this](Status& status) { corners_->describe(status); });
}

void VehicleDiagnostics::publish(const MessagePipeline* pipeline) {
  coupling_.publish(monitorOf(pipeline), whyNoMonitor(pipeline),
                    pipeline != nullptr ? toRosTime(pipeline->newest()) : ros::Time());
  if (corners_) corners_->publish(pipeline);
  pipeline_ = pipeline;
  updater_.force_update();
  pipeline_ = nullptr;
}

std::string VehicleDiagnostics::whyNoMonitor(const MessagePipeline* pipeline) const {
  if (pipeline == nullptr) return placement_.missing();
  const VehicleMonitor* monitor = pipeline->monitor();
  if (monitor == nullptr) return kMeasuringPeriod;
  return "the drives so far " + suspension_health_monitor::whyNotCoupled(monitor->mistake(), struts_);
}

}  // namespace suspension_health_monitor
