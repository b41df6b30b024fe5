#include "monitor_diagnostics.h"

#include "tyre_output.h"

namespace suspension_health_monitor {

MonitorDiagnostics::MonitorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                       const std::string& name, const PipelineOptions& options,
                                       const std::array<std::string, 2>& topics, const LiveModel& model)
    : input_(options.shell, topics),
      strut_(options.shell.input_timeout, model, [this] { return input_.silentTopics(); }),
      updater_(node, private_node, name) {
  updater_.setHardwareID(name.substr(name.find_first_not_of('/')));
  updater_.add("Input", [this](Status& status) { input_.describe(*pipeline_, status); });
  strut_.addTo(updater_, [this](std::string& why_none) {
    why_none = kMeasuringPeriod;
    return pipeline_->monitor();
  });
  if (options.monitor.tyre) updater_.add("Tyre", [this](Status& status) { describeTyre(*pipeline_, status); });
}

void MonitorDiagnostics::publish(const ImuPipeline& pipeline) {
  pipeline_ = &pipeline;
  updater_.force_update();
  pipeline_ = nullptr;
}

}  // namespace suspension_health_monitor
