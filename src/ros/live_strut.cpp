#include "live_strut.h"

#include <ros/console.h>

#include <stdexcept>
#include <utility>

namespace suspension_health_monitor {

LiveStrut::LiveStrut(const std::string& name, const PipelineOptions& options, const std::string& model_of, Host host)
    : name_(name),
      prefix_(name.empty() ? "" : name + ": "),
      options_(options),
      host_(std::move(host)),
      model_(options.shell, model_of),
      baseline_(options),
      diagnostics_(host_.title, options.shell.input_timeout, model_, host_.silent_topics) {
  host_.model_changed = [this] {
    publishModel();
    publishDiagnostics();
  };
}

void LiveStrut::start(const ros::NodeHandle& node, const ros::NodeHandle& private_node) {
  for (const std::string& remark : model_.remarks()) ROS_WARN("%s%s", prefix_.c_str(), remark.c_str());
  ros::NodeHandle own = name_.empty() ? private_node : ros::NodeHandle(node, name_);
  reports_.emplace(own, options_);
  publishModel();
  updater_.emplace(node, private_node, own.getNamespace());
  updater_->setHardwareID(own.getNamespace().substr(1));
  updater_->add("Input", [this](Status& status) { host_.describe_input(status); });
  diagnostics_.addTo(*updater_, [this](std::string& why_none) {
    why_none = host_.why_none();
    return host_.monitor();
  });
  services_.emplace(own, options_.shell, model_, baseline_, host_);
  diagnose_.emplace(own, *host_.queue, host_.search);
}

void LiveStrut::publishModel() {
  const SuspensionMonitor* monitor = host_.monitor();
  reports_->model().change(monitor != nullptr ? monitor->effects() : model_.effects(), monitor, host_.frame());
}

void LiveStrut::publish(const MonitorReport& report) {
  if (diagnostics_.note(report)) publishDiagnostics();
  if (report.health.learned && !baseline_.known()) keepBaseline();
  reports_->publish(report, *host_.monitor(), host_.frame());
}

void LiveStrut::keepBaseline() {
  try {
    ROS_INFO("%s%s", prefix_.c_str(), baseline_.keepLearned(*host_.monitor()).c_str());
  } catch (const std::runtime_error& error) {
    ROS_ERROR("%s%s", prefix_.c_str(), error.what());
  }
}

}  // namespace suspension_health_monitor
