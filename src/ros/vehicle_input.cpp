#include "vehicle_input.h"

#include <algorithm>

#include "strut_diagnostics.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr const char* kWrenchType = "geometry_msgs/WrenchStamped";

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
    : max_lag_(options.max_lag), silent_(topics, fromSeconds(options.input_timeout)) {
  for (std::size_t i = 0; i < streams.sensors.size(); ++i)
    sensors_.push_back({topics[i],
                        expectedRate(streams.sensors[i].place, options),
                        ImuArrivals(topics[i], options.input_timeout,
                                    streams.sensors[i].place == VehicleStreams::Place::kForce ? kWrenchType : kImuType),
                        {},
                        {}});
  for (std::size_t i = 0; i < sensors_.size(); ++i) all_sensors_.push_back(i);
  for (const VehicleChannels::Strut& strut : streams.channels.struts) {
    own_sensors_.push_back({streams.options[strut.unsprung].sensor});
    if (strut.sprung) own_sensors_.back().push_back(streams.options[*strut.sprung].sensor);
  }
}

void VehicleInput::restart() {
  series_ = {};
  for (Sensor& sensor : sensors_) sensor.told_of_vehicle = sensor.told_of_strut = {};
  refusal_.clear();
}

void VehicleInput::describe(const VehiclePipeline* pipeline, const std::string& missing, ImuArrivals::Status& status) {
  summarize(all_sensors_, pipeline, missing, status);
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
  describeSensors(all_sensors_, pipeline, &Sensor::told_of_vehicle, status);
  clock_.describe(status);
}

void VehicleInput::describeStrut(std::size_t strut, const VehiclePipeline* pipeline, const std::string& missing,
                                 ImuArrivals::Status& status) {
  summarize(own_sensors_[strut], pipeline, missing, status);
  describeSensors(own_sensors_[strut], pipeline, &Sensor::told_of_strut, status);
}

void VehicleInput::summarize(const std::vector<std::size_t>& sensors, const VehiclePipeline* pipeline,
                             const std::string& missing, ImuArrivals::Status& status) const {
  const auto isSilent = [this](std::size_t sensor) { return sensors_[sensor].arrivals.isSilentByWall(); };
  if (pipeline == nullptr)
    status.summary(DiagnosticStatus::ERROR, missing);
  else if (pipeline->monitor() == nullptr)
    status.summary(DiagnosticStatus::OK, kMeasuringPeriod);
  else if (clock_.standsStill() && std::all_of(sensors.begin(), sensors.end(), isSilent))
    status.summary(DiagnosticStatus::OK, "nothing arrives at present");
  else
    status.summary(DiagnosticStatus::OK, "all sensors arrive as expected");
}

void VehicleInput::describeSensors(const std::vector<std::size_t>& sensors, const VehiclePipeline* pipeline, Told told,
                                   ImuArrivals::Status& status) {
  for (const std::size_t sensor : sensors)
    if (pipeline != nullptr) describeSensor(sensor, *pipeline, told, status);
  if (!refusal_.empty())
    return status.mergeSummary(DiagnosticStatus::ERROR, "stopped listening until reset: " + refusal_);
  for (const std::size_t sensor : sensors) sensors_[sensor].arrivals.describeSilence(published_, status);
}

void VehicleInput::describeSensor(std::size_t sensor, const VehiclePipeline& pipeline, Told told,
                                  ImuArrivals::Status& status) {
  Sensor& its = sensors_[sensor];
  its.arrivals.describeLag(its.topic, max_lag_, status);
  if (pipeline.grid() != nullptr) {
    describeTiming(pipeline.grid()->gate(sensor).timing(), its.topic, its.expected_rate, status);
    status.add(its.topic + " waited for in vain", pipeline.grid()->missed(sensor));
  }
  if (const std::string newly = (its.*told).describe(pipeline.rejected(sensor), its.topic, status); !newly.empty())
    status.mergeSummary(DiagnosticStatus::WARN, "readings of " + its.topic + " rejected: " + newly);
}

}  // namespace suspension_health_monitor
