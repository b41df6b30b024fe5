#include "vehicle_input.h"

#include <algorithm>

#include "strut_diagnostics.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using Place = VehicleStreams::Place;

// @return [Hz]
std::optional<double> expectedRate(Place place, const ShellOptions& options) {
  if (place == Place::kForce) return std::nullopt;
  return place == Place::kUnsprung ? options.unsprung_rate : options.sprung_rate;
}

}  // namespace

VehicleInput::VehicleInput(const ShellOptions& options, const VehicleStreams& streams,
                           const std::vector<std::string>& topics)
    : max_lag_(options.max_lag) {
  for (std::size_t i = 0; i < streams.sensors.size(); ++i)
    sensors_.push_back({topics[i],
                        expectedRate(streams.sensors[i].place, options),
                        ImuArrivals(topics[i], options.input_timeout),
                        {}});
}

void VehicleInput::restart() {
  series_ = {};
  for (Sensor& sensor : sensors_) sensor.rejected = {};
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
    if (const std::string leans = suspension_health_monitor::describe(pipeline->grid()->bodyLevel()); !leans.empty())
      status.add("body IMU", leans);
  }
  for (std::size_t i = 0; pipeline != nullptr && i < sensors_.size(); ++i)
    describeSensor(sensors_[i], *pipeline, i, status);
  if (refusal_.empty())
    for (const Sensor& sensor : sensors_) sensor.arrivals.describeSilence(status);
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
  else if (clock_.standsStill() && std::all_of(sensors_.begin(), sensors_.end(),
                                               [](const Sensor& sensor) { return sensor.arrivals.isSilentByWall(); }))
    status.summary(DiagnosticStatus::OK, "nothing arrives at present");
  else
    status.summary(DiagnosticStatus::OK, "all sensors arrive as expected");
}

void VehicleInput::describeSensor(Sensor& sensor, const VehiclePipeline& pipeline, std::size_t place,
                                  ImuArrivals::Status& status) {
  sensor.arrivals.describeLag(sensor.topic, max_lag_, status);
  if (pipeline.grid() != nullptr) {
    describeTiming(pipeline.grid()->gate(place).timing(), sensor.topic, sensor.expected_rate, status);
    status.add(sensor.topic + " waited for in vain", pipeline.grid()->missed(place));
  }
  if (const std::string newly = sensor.rejected.describe(pipeline.rejected(place), sensor.topic, status);
      !newly.empty())
    status.mergeSummary(DiagnosticStatus::WARN, "readings of " + sensor.topic + " rejected: " + newly);
}

}  // namespace suspension_health_monitor
