#include "input_task.h"

#include <algorithm>
#include <utility>

#include "strut_diagnostics.h"

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

}  // namespace

InputTask::InputTask(const ShellOptions& options, const std::vector<std::string>& topics, std::vector<Sensor> sensors)
    : sensors_(std::move(sensors)), max_lag_(options.max_lag), silent_(topics, fromSeconds(options.input_timeout)) {
  for (std::size_t i = 0; i < sensors_.size(); ++i) all_sensors_.push_back(i);
}

void InputTask::restart() {
  series_ = {};
  refusal_.clear();
}

void InputTask::summarize(const Sensors& sensors, bool has_monitor, const char* well, Status& status) const {
  const auto isSilent = [this](std::size_t sensor) { return sensors_[sensor].arrivals.isSilentByWall(); };
  if (!has_monitor)
    status.summary(DiagnosticStatus::OK, kMeasuringPeriod);
  else if (clock_.standsStill() && std::all_of(sensors.begin(), sensors.end(), isSilent))
    status.summary(DiagnosticStatus::OK, "nothing arrives at present");
  else
    status.summary(DiagnosticStatus::OK, well);
}

void InputTask::describeGrid(const SuspensionMonitor* monitor, const StreamGrid* grid, Status& status) {
  if (monitor != nullptr) series_.describe(*monitor, status);
  if (grid == nullptr) return;
  const std::string slow = grid->resamples() ? "" : grid->whatIsTooSlow();
  if (!slow.empty()) status.mergeSummary(DiagnosticStatus::WARN, slow);
  status.add("alignment", grid->describeAlignment());
  status.add("bridged", grid->bridged());
}

void InputTask::describeSensor(std::size_t sensor, const StreamGate* gate, Status& status) const {
  const Sensor& its = sensors_[sensor];
  its.arrivals.describeLag(its.name, max_lag_, status);
  if (gate != nullptr) describeTiming(gate->clock(), its.name, its.expected_rate, status);
}

void InputTask::describeMounts(const MessagePipeline& pipeline, Status& status) const {
  std::vector<std::string> names;
  for (const Sensor& sensor : sensors_) names.push_back("the " + sensor.name + " IMU");
  for (const std::string& fault : pipeline.mountFaults(names))
    if (!fault.empty()) status.mergeSummary(DiagnosticStatus::WARN, fault);
}

void InputTask::describeSilence(const Sensors& sensors, Status& status) {
  if (!refusal_.empty())
    return status.mergeSummary(DiagnosticStatus::ERROR, "stopped listening until reset: " + refusal_);
  for (const std::size_t sensor : sensors) sensors_[sensor].arrivals.describeSilence(published_, status);
}

}  // namespace suspension_health_monitor
