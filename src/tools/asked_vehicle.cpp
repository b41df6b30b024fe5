#include "asked_vehicle.h"

#include <stdexcept>

#include "../ros/vehicle_options.h"
#include "../ros/vehicle_sensors.h"
#include "bag_options.h"
#include "command.h"
#include "suspension_health_monitor/internal/text.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

VehicleLayout layoutOfTopics(const po::variables_map& values) {
  std::vector<std::string> topics;
  for (const std::string option : kTopicOptions)
    if (const std::string name = option.substr(2); values.count(name) != 0)
      topics.push_back(values[name].as<std::string>());
  for (std::size_t i = 0; i < topics.size(); ++i)
    if (topics[i].empty()) throw std::invalid_argument(std::string(kTopicOptions[i]) + " is empty, must be a topic");
  if (topics[0] == topics[1])
    throw std::invalid_argument("--sprung-topic and --unsprung-topic are both " + topics[0] + ", must differ");
  VehicleLayout layout = VehicleLayout::ofOneStrut(false);
  layout.struts.front().sprung_imu = topics[0];
  layout.struts.front().unsprung_imu = topics[1];
  if (topics.size() == 2) return layout;
  if (topics[2] == topics[0] || topics[2] == topics[1])
    throw std::invalid_argument("--road-topic " + topics[2] + " is one of the other two, must differ");
  layout.road_imu = topics[2];
  return layout;
}

/// Looks up the positions of struts that have a frame.
void place(VehicleLayout& layout, ImuBags bags, const ShellOptions& options) {
  if (!layout.hasFrames() || !layout.body_imu) return;
  bags.transforms = readStaticTransforms(bags.paths);
  bags.topics = {{*layout.body_imu, "body_imu"}};
  std::optional<sensor_msgs::Imu> first;
  const auto take = [&](std::size_t, const sensor_msgs::Imu& imu, Stamp) {
    first = imu;
    return false;
  };
  readTopics(bags, {take, {}});
  if (!first) throw TooLittleError("the bags hold no message of body_imu, " + *layout.body_imu);
  placeFrames(layout, *first, options, *bags.transforms);
}

}  // namespace

AskedVehicle readVehicle(const po::variables_map& values) {
  const std::string strut = values.count(kStrut) != 0 ? values[kStrut].as<std::string>() : "";
  if (values.count(kVehicle) == 0) {
    if (values.count(kStrut) != 0)
      throw std::invalid_argument("--strut " + strut + " without --vehicle, which it is of");
    return {layoutOfTopics(values), "", {""}, {0}, 0};
  }
  for (const std::string option : kTopicOptions)
    if (const std::string name = option.substr(2); values.count(name) != 0 && !values[name].defaulted())
      throw std::invalid_argument(option + " beside --vehicle, must be left out");
  AskedVehicle vehicle;
  vehicle.file = values[kVehicle].as<std::string>();
  vehicle.layout = readVehicleFile(vehicle.file);
  vehicle.names = namesOf(vehicle.layout.struts);
  for (std::size_t i = 0; i < vehicle.names.size(); ++i)
    if (values.count(kStrut) == 0 || strut == vehicle.names[i]) vehicle.asked.push_back(i);
  if (vehicle.asked.empty())
    throw std::invalid_argument("--strut " + strut + ", must be one of " + join(vehicle.names));
  if (values.count(kStrut) != 0) vehicle.only = vehicle.asked.front();
  return vehicle;
}

void findSensors(ImuBags& bags, const ShellOptions& options, VehicleLayout& layout) {
  place(layout, bags, options);
  const VehicleStreams streams(layout);
  bags.topics.clear();
  for (const VehicleStreams::Sensor& sensor : streams.sensors)
    bags.topics.push_back({sensor.topic, sensor.setting, sensor.place == VehicleStreams::Place::kForce,
                           sensor.place != VehicleStreams::Place::kRoad});
}

}  // namespace suspension_health_monitor
