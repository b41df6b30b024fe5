#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kSixAxes = 6;

}  // namespace

VehicleStreams::VehicleStreams(const VehicleLayout& layout) {
  const auto add = [&](const std::string& topic, Place place, std::size_t count, const std::string& setting) {
    sensors.push_back({topic, place, options.size(), setting});
    options.insert(options.end(), count, StreamOptions{sensors.size() - 1, place != Place::kRoad});
    return sensors.back().stream;
  };
  const bool needs_body = std::any_of(layout.struts.begin(), layout.struts.end(),
                                      [](const VehicleLayout::Strut& strut) { return !strut.sprung_imu; });
  if (needs_body) {
    if (!layout.body_imu) throw std::invalid_argument("body_imu is missing: a strut has no sprung_imu");
    channels.body_imu = add(*layout.body_imu, Place::kBody, kSixAxes, "body_imu");
  }
  for (const VehicleLayout::Strut& strut : layout.struts) {
    const std::string where = "struts/" + strut.name;
    VehicleChannels::Strut its;
    if (strut.position) its.position.emplace((*strut.position)[0], (*strut.position)[1], (*strut.position)[2]);
    if (strut.sprung_imu)
      its.sprung = add(*strut.sprung_imu, Place::kSprung, 1, where + "/sprung_imu");
    else if (!strut.position)
      throw std::invalid_argument(where + " has no position, and no sprung_imu");
    its.unsprung = add(strut.unsprung_imu, Place::kUnsprung, 1, where + "/unsprung_imu");
    channels.struts.push_back(its);
  }
  if (layout.road_imu) channels.road = add(*layout.road_imu, Place::kRoad, 1, "road_imu");
  addForces(layout.known_forces);
}

void VehicleStreams::addForces(const std::vector<VehicleLayout::KnownForce>& forces) {
  const auto num_imus = static_cast<std::ptrdiff_t>(sensors.size());
  const auto ofTopic = [&](const std::string& topic) {
    return std::find_if(sensors.begin() + num_imus, sensors.end(),
                        [&](const Sensor& sensor) { return sensor.topic == topic; });
  };
  for (const VehicleLayout::KnownForce& force : forces) {
    if (ofTopic(force.topic) == sensors.end())
      sensors.push_back({force.topic, Place::kForce, 0, "known_forces/" + force.name + "/topic"});
    ofTopic(force.topic)->fields.push_back(force.field);
  }
  for (auto sensor = sensors.begin() + num_imus; sensor != sensors.end(); ++sensor) {
    sensor->stream = options.size();
    const auto number = static_cast<std::size_t>(sensor - sensors.begin());
    options.insert(options.end(), sensor->fields.size(), StreamOptions{number, true, true});
  }
  for (const VehicleLayout::KnownForce& force : forces) {
    const std::vector<std::size_t>& fields = ofTopic(force.topic)->fields;
    const auto place = std::find(fields.begin(), fields.end(), force.field) - fields.begin();
    channels.known_forces.push_back(ofTopic(force.topic)->stream + static_cast<std::size_t>(place));
  }
}

std::size_t VehicleStreams::bodyImuOf(std::size_t strut) const {
  const std::optional<std::size_t>& own = channels.struts[strut].sprung;
  return options[own ? *own : *channels.body_imu].sensor;
}

}  // namespace suspension_health_monitor
