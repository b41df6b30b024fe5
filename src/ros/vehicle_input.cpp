#include "vehicle_input.h"

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
    : InputTask(options, topics, [&] {
        std::vector<Sensor> sensors;
        for (std::size_t i = 0; i < streams.sensors.size(); ++i) {
          const Place place = streams.sensors[i].place;
          sensors.push_back(
              {topics[i], expectedRate(place, options),
               ImuArrivals(topics[i], options.input_timeout, place == Place::kForce ? kWrenchType : kImuType)});
        }
        return sensors;
      }()) {
  told_of_vehicle_ = told_of_strut_ = Told(sensors_.size());
  for (const VehicleChannels::Strut& strut : streams.channels.struts) {
    own_sensors_.push_back({streams.options[strut.unsprung].sensor});
    if (strut.sprung) own_sensors_.back().push_back(streams.options[*strut.sprung].sensor);
  }
}

void VehicleInput::restart() {
  InputTask::restart();
  told_of_vehicle_ = told_of_strut_ = Told(sensors_.size());
}

void VehicleInput::describe(const MessagePipeline* pipeline, const std::string& missing, Status& status) {
  summarizeVehicle(all_sensors_, pipeline, missing, status);
  if (pipeline != nullptr && pipeline->monitor() != nullptr) {
    describeGrid(pipeline->monitor()->strut(0), &pipeline->grid()->streams(), status);
    if (const std::string leans = suspension_health_monitor::describe(pipeline->grid()->bodyLevel()); !leans.empty())
      status.add("body IMU", leans);
  }
  if (pipeline != nullptr) describeMounts(*pipeline, status);
  describeSensors(all_sensors_, pipeline, told_of_vehicle_, status);
  clock_.describe(status);
}

void VehicleInput::describeStrut(std::size_t strut, const MessagePipeline* pipeline, const std::string& missing,
                                 Status& status) {
  summarizeVehicle(own_sensors_[strut], pipeline, missing, status);
  describeSensors(own_sensors_[strut], pipeline, told_of_strut_, status);
}

void VehicleInput::summarizeVehicle(const Sensors& sensors, const MessagePipeline* pipeline, const std::string& missing,
                                    Status& status) const {
  if (pipeline == nullptr) return status.summary(DiagnosticStatus::ERROR, missing);
  summarize(sensors, pipeline->monitor() != nullptr, "all sensors arrive as expected", status);
}

void VehicleInput::describeSensors(const Sensors& sensors, const MessagePipeline* pipeline, Told& told,
                                   Status& status) {
  for (const std::size_t sensor : sensors) {
    if (pipeline == nullptr) break;
    const VehicleGrid* grid = pipeline->grid();
    const std::string& topic = sensors_[sensor].name;
    describeSensor(sensor, grid != nullptr ? &grid->gate(sensor) : nullptr, status);
    if (grid != nullptr) status.add(topic + " waited for in vain", grid->missed(sensor));
    if (const std::string newly = told[sensor].describe(pipeline->rejected(sensor), topic, status); !newly.empty())
      status.mergeSummary(DiagnosticStatus::WARN, "readings of " + topic + " rejected: " + newly);
  }
  describeSilence(sensors, status);
}

}  // namespace suspension_health_monitor
