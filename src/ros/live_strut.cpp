#include "live_strut.h"

#include <ros/console.h>

#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/prefixed.h"

namespace suspension_health_monitor {

LiveStrut::LiveStrut(const std::string& name, std::size_t place, const PipelineOptions& options,
                     const std::string& model_of, Vehicle vehicle)
    : name_(name),
      place_(place),
      options_(options),
      vehicle_(std::move(vehicle)),
      model_(prefixed("struts/" + name + ": ", [&] { return LiveModel(options.shell, model_of); })),
      baseline_(prefixed("struts/" + name + ": ", [&] { return LiveBaseline(options); })),
      diagnostics_(name, options.shell.input_timeout, model_, vehicle_.silent_topics) {}

void LiveStrut::start(const ros::NodeHandle& node, const ros::NodeHandle& private_node) {
  for (const std::string& remark : model_.remarks()) ROS_WARN("%s: %s", name_.c_str(), remark.c_str());
  ros::NodeHandle own(node, name_);
  reports_.emplace(own, options_);
  publishModel();
  updater_.emplace(node, private_node, own.getNamespace());
  updater_->setHardwareID(own.getNamespace().substr(1));
  updater_->add("Input",
                [this](diagnostic_updater::DiagnosticStatusWrapper& status) { vehicle_.describe_input(status); });
  diagnostics_.addTo(*updater_, [this](std::string& why_none) {
    why_none = vehicle_.why_none();
    return monitor();
  });
  services_.emplace(own, options_.shell, model_, baseline_,
                    StrutServices::Strut{[this] { return monitor(); },
                                         [this](const auto& effects, const auto& strut) {
                                           if (VehicleMonitor* all = vehicle_.monitor())
                                             all->setEffects(place_, effects, strut);
                                         },
                                         [this](const Baseline& baseline) {
                                           if (VehicleMonitor* all = vehicle_.monitor())
                                             all->setBaseline(place_, baseline);
                                         },
                                         vehicle_.newest_samples,
                                         [this] {
                                           publishModel();
                                           publishDiagnostics();
                                         },
                                         vehicle_.reset});
  diagnose_.emplace(own, *vehicle_.queue, vehicle_.search);
}

void LiveStrut::begin(VehicleMonitor& monitor) const {
  monitor.setEffects(place_, model_.effects(), model_.strutFor(model_.effects()));
  if (baseline_.known()) monitor.setBaseline(place_, *baseline_.known());
}

const SuspensionMonitor* LiveStrut::monitor() const {
  const VehicleMonitor* all = vehicle_.monitor();
  return all != nullptr ? all->strut(place_) : nullptr;
}

void LiveStrut::publishModel() {
  const SuspensionMonitor* its = monitor();
  reports_->model().change(its != nullptr ? its->effects() : model_.effects(), its, vehicle_.frame());
}

void LiveStrut::publish(const MonitorReport& report) {
  if (diagnostics_.note(report)) publishDiagnostics();
  if (report.health.learned && !baseline_.known()) keepBaseline();
  reports_->publish(report, *monitor(), nullptr, vehicle_.frame());
}

void LiveStrut::keepBaseline() {
  try {
    ROS_INFO("%s: %s", name_.c_str(), baseline_.keepLearned(*monitor()).c_str());
  } catch (const std::runtime_error& error) {
    ROS_ERROR("%s: %s", name_.c_str(), error.what());
  }
}

}  // namespace suspension_health_monitor
