#include "input_diagnostics.h"

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

}  // namespace

InputDiagnostics::InputDiagnostics(const ShellOptions& options, const std::array<std::string, 2>& topics)
    : InputTask(options, {topics.begin(), topics.end()},
                {{"sprung", options.sprung_rate, ImuArrivals(topics[0], options.input_timeout, kImuType)},
                 {"unsprung", options.unsprung_rate, ImuArrivals(topics[1], options.input_timeout, kImuType)}}),
      target_frame_(options.target_frame) {}

void InputDiagnostics::restart() {
  InputTask::restart();
  rejected_ = {};
}

void InputDiagnostics::describe(const MessagePipeline& pipeline, Status& status) {
  const VehicleGrid* grid = pipeline.grid();
  const SuspensionMonitor* monitor = pipeline.strut();
  const bool any_usable = monitor != nullptr && monitor->input().samples > 0;
  if (!any_usable && pipeline.rejected().total() > 0)
    status.summary(DiagnosticStatus::WARN, "no usable pair of readings yet");
  else
    summarize(all_sensors_, monitor != nullptr, "both IMUs arrive as expected", status);
  describeGrid(monitor, grid != nullptr ? &grid->streams() : nullptr, status);
  for (const Side side : {Side::kSprung, Side::kUnsprung}) {
    describeSensor(indexOf(side), grid != nullptr ? &grid->gate(indexOf(side)) : nullptr, status);
    if (grid != nullptr)
      status.add(sensors_[indexOf(side)].name + " rejected", grid->gate(indexOf(side)).rejected().total());
  }
  if (const std::string newly = rejected_.describe(pipeline.rejected(), "", status); !newly.empty())
    status.mergeSummary(DiagnosticStatus::WARN, "readings rejected: " + newly);
  describeTransforms(pipeline, status);
  describeMounts(pipeline, status);
  describeSilence(all_sensors_, status);
  clock_.describe(status);
}

void InputDiagnostics::describeTransforms(const MessagePipeline& pipeline, Status& status) const {
  for (const Side side : {Side::kSprung, Side::kUnsprung})
    if (const std::string& frame = pipeline.missingTransform(indexOf(side)); !frame.empty())
      status.mergeSummary(DiagnosticStatus::ERROR,
                          "no static transform from " + frame + " to target_frame " + target_frame_ + " (/tf_static)");
}

}  // namespace suspension_health_monitor
