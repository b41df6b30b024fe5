#include "input_diagnostics.h"

#include <algorithm>

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr std::array<const char*, 2> kSideNames{"sprung", "unsprung"};

}  // namespace

InputDiagnostics::InputDiagnostics(const ShellOptions& options, const std::array<std::string, 2>& topics)
    : options_(options),
      arrivals_{ImuArrivals(topics[0], options.input_timeout, kImuType),
                ImuArrivals(topics[1], options.input_timeout, kImuType)},
      silent_({topics.begin(), topics.end()}, fromSeconds(options.input_timeout)) {}

void InputDiagnostics::restart() {
  series_ = {};
  rejected_ = {};
  refusal_.clear();
}

void InputDiagnostics::describe(const ImuPipeline& pipeline, Status& status) {
  summarize(pipeline, status);
  if (pipeline.monitor() != nullptr) series_.describe(*pipeline.monitor(), status);
  if (pipeline.strut().grid() != nullptr) {
    const std::string slow =
        pipeline.strut().grid()->streams().resamples() ? "" : pipeline.strut().grid()->streams().whatIsTooSlow();
    if (!slow.empty()) status.mergeSummary(DiagnosticStatus::WARN, slow);
    status.add("alignment", pipeline.strut().grid()->streams().describeAlignment());
    status.add("bridged", pipeline.strut().grid()->streams().bridged());
  }
  for (const Side side : {Side::kSprung, Side::kUnsprung}) describeStream(side, pipeline, status);
  if (const std::string newly = rejected_.describe(pipeline.rejected(), "", status); !newly.empty())
    status.mergeSummary(DiagnosticStatus::WARN, "readings rejected: " + newly);
  describeTransforms(pipeline, status);
  if (refusal_.empty())
    for (const ImuArrivals& imu : arrivals_) imu.describeSilence(published_, status);
  else
    status.mergeSummary(DiagnosticStatus::ERROR, "stopped listening until reset: " + refusal_);
  clock_.describe(status);
}

void InputDiagnostics::summarize(const ImuPipeline& pipeline, Status& status) const {
  const bool any_usable = pipeline.monitor() != nullptr && pipeline.monitor()->input().samples > 0;
  if (!any_usable && pipeline.rejected().total() > 0)
    status.summary(DiagnosticStatus::WARN, "no usable pair of readings yet");
  else if (pipeline.monitor() == nullptr)
    status.summary(DiagnosticStatus::OK, "measuring the sample period");
  else if (clock_.standsStill() &&
           std::all_of(arrivals_.begin(), arrivals_.end(), [](const ImuArrivals& imu) { return imu.isSilentByWall(); }))
    status.summary(DiagnosticStatus::OK, "nothing arrives at present");
  else
    status.summary(DiagnosticStatus::OK, "both IMUs arrive as expected");
}

void InputDiagnostics::describeStream(Side side, const ImuPipeline& pipeline, Status& status) const {
  const auto index = static_cast<std::size_t>(side);
  const std::string name = kSideNames[index];
  arrivals_[index].describeLag(name, options_.max_lag, status);
  if (pipeline.strut().grid() == nullptr) return;
  const StreamGate& gate = pipeline.strut().grid()->gate(side);
  describeTiming(gate.timing(), name, side == Side::kSprung ? options_.sprung_rate : options_.unsprung_rate, status);
  status.add(name + " rejected", gate.rejected().total());
}

void InputDiagnostics::describeTransforms(const ImuPipeline& pipeline, Status& status) const {
  for (const Side side : {Side::kSprung, Side::kUnsprung})
    if (const std::string& frame = pipeline.mount(side).missingTransform(); !frame.empty())
      status.mergeSummary(DiagnosticStatus::ERROR, "no static transform from " + frame + " to target_frame " +
                                                       options_.target_frame + " (/tf_static)");
}

}  // namespace suspension_health_monitor
