#include "vehicle_input.h"

#include <algorithm>

#include "strut_diagnostics.h"

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

}  // namespace

VehicleInput::VehicleInput(const ShellOptions& options, const VehicleStreams& streams,
                           const std::vector<std::string>& topics)
    : max_lag_(options.max_lag) {
  for (std::size_t i = 0; i < streams.imus.size(); ++i) {
    const bool is_wheel = streams.imus[i].place == VehicleStreams::Place::kUnsprung;
    imus_.push_back({topics[i],
                     is_wheel ? options.unsprung_rate : options.sprung_rate,
                     ImuArrivals(topics[i], options.input_timeout),
                     {}});
  }
}

void VehicleInput::restart() {
  series_ = {};
  for (Imu& imu : imus_) imu.rejected = {};
  refusal_.clear();
}

void VehicleInput::describe(const VehiclePipeline* pipeline, const std::string& missing, ImuArrivals::Status& status) {
  summarize(pipeline, missing, status);
  if (pipeline != nullptr && pipeline->monitor() != nullptr) {
    if (const SuspensionMonitor* first = pipeline->monitor()->strut(0)) series_.describe(*first, status);
    const StreamGrid& grid = pipeline->grid()->streams();
    const std::string slow = grid.resamples() ? "" : grid.whatIsTooSlow();
    if (!slow.empty()) status.mergeSummary(DiagnosticStatus::WARN, slow);
    status.add("alignment", grid.describeAlignment());
    status.add("bridged", grid.bridged());
  }
  for (std::size_t i = 0; pipeline != nullptr && i < imus_.size(); ++i) describeImu(imus_[i], *pipeline, i, status);
  if (refusal_.empty())
    for (const Imu& imu : imus_) imu.arrivals.describeSilence(status);
  else
    status.mergeSummary(DiagnosticStatus::ERROR, "stopped listening until reset: " + refusal_);
  clock_.describe(status);
}

void VehicleInput::summarize(const VehiclePipeline* pipeline, const std::string& missing,
                             ImuArrivals::Status& status) const {
  if (pipeline == nullptr)
    status.summary(DiagnosticStatus::ERROR, missing);
  else if (pipeline->monitor() == nullptr)
    status.summary(DiagnosticStatus::OK, kMeasuringPeriod);
  else if (clock_.standsStill() &&
           std::all_of(imus_.begin(), imus_.end(), [](const Imu& imu) { return imu.arrivals.isSilentByWall(); }))
    status.summary(DiagnosticStatus::OK, "nothing arrives at present");
  else
    status.summary(DiagnosticStatus::OK, "all IMUs arrive as expected");
}

void VehicleInput::describeImu(Imu& imu, const VehiclePipeline& pipeline, std::size_t place,
                               ImuArrivals::Status& status) {
  imu.arrivals.describeLag(imu.topic, max_lag_, status);
  if (pipeline.grid() != nullptr) {
    describeTiming(pipeline.grid()->gate(place).timing(), imu.topic, imu.expected_rate, status);
    status.add(imu.topic + " waited for in vain", pipeline.grid()->missed(place));
  }
  if (const std::string newly = imu.rejected.describe(pipeline.rejected(place), imu.topic, status); !newly.empty())
    status.mergeSummary(DiagnosticStatus::WARN, "readings of " + imu.topic + " rejected: " + newly);
}

}  // namespace suspension_health_monitor
