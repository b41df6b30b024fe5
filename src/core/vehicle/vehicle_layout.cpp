#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

std::string quoted(const std::string& text) { return " = \"" + shortened(text) + '"'; }

/// @param more  characters that may stand in the text besides those of a name.
/// @param first  those that it may begin with besides letters.
bool isMadeOf(const std::string& text, const std::string& more, const std::string& first) {
  return text.find_first_of(kLetters + first) == 0 &&
         text.find_first_not_of(kNameCharacters + more) == std::string::npos;
}

void checkTopic(const std::string& where, const std::string& topic) {
  if (!isMadeOf(topic, "/", "/~") && !(topic.size() > 1 && topic[0] == '~' && isMadeOf(topic.substr(1), "/", "/")))
    refuse(where + quoted(topic) + ", must be a topic: letters, digits, _ and /, such as /imu/data");
}

void checkNumber(const std::string& what, std::size_t number, int most) {
  if (number > static_cast<std::size_t>(most))
    refuse(what + ": " + std::to_string(number) + " of them, must be at most " + std::to_string(most));
}

std::array<double, 3> toPosition(const std::string& where, const OptionValue& value) {
  const auto* list = std::get_if<UnusableList>(&value);
  const auto* words = std::get_if<std::string>(&value);
  const std::string text = list != nullptr ? list->text : words != nullptr ? '[' + *words + ']' : "";
  const std::string allowed =
      where + (text.empty() ? "" : " = " + shortened(text)) + ", must be three numbers [x, y, z] in [-100, 100] [m]";
  if (text.size() < 2) refuse(allowed);
  std::vector<std::string> parts;
  const std::string inside = text.substr(1, text.size() - 2);
  boost::algorithm::split(parts, inside, [](char c) { return c == ','; });
  std::array<double, 3> position{};
  if (parts.size() != position.size()) refuse(allowed);
  const double most = kVehicleTuning.farthest;
  try {
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] = toNumber(where, boost::algorithm::trim_copy(parts[i]), -most, most);
  } catch (const std::invalid_argument&) {
    refuse(allowed);
  }
  return position;
}

VehicleLayout::Strut toStrut(const std::string& name, OptionMap values, bool has_body_imu) {
  const std::string where = "struts/" + shortened(name);
  requireName(where, name);
  const auto position = values.extract("position");
  const auto [unsprung_imu, sprung_imu, frame] =
      takeTexts(where, std::move(values), {"unsprung_imu", "sprung_imu", "frame"}, {"position"});
  if (unsprung_imu.empty()) refuse(where + "/unsprung_imu is missing: every strut needs the IMU at its wheel");
  VehicleLayout::Strut strut;
  strut.name = name;
  strut.unsprung_imu = unsprung_imu;
  if (!sprung_imu.empty()) strut.sprung_imu = sprung_imu;
  if (!frame.empty()) strut.frame = frame;
  if (position) strut.position = toPosition(where + "/position", position.mapped());
  if (strut.position && strut.frame) refuse(where + " has a position and a frame, must have one of them");
  if (strut.frame && !isMadeOf(*strut.frame, "/", "/"))
    refuse(where + "/frame" + quoted(*strut.frame) + ", must be letters, digits, _ and /");
  if (strut.sprung_imu) return strut;
  if (!has_body_imu) refuse(where + "/sprung_imu is missing; without it the vehicle needs a body_imu");
  if (!strut.position && !strut.frame)
    refuse(where +
           " has no sprung_imu, so it needs its position in the frame of body_imu: position: [x, y, z] [m], or "
           "frame: NAME");
  return strut;
}

VehicleLayout::KnownForce toForce(const std::string& name, const OptionMap& values) {
  const std::string where = "known_forces/" + shortened(name);
  requireName(where, name);
  const auto [topic, field] = takeTexts(where, values, {"topic", "field"});
  for (const auto& [wanted, text] : {std::pair("topic", topic), std::pair("field", field)})
    if (text.empty()) refuse(where + '/' + wanted + " is missing; a known force has topic, field");
  checkTopic(where + "/topic", topic);
  const auto found = std::find(kWrenchFields.begin(), kWrenchFields.end(), field);
  if (found == kWrenchFields.end())
    refuse(where + "/field" + quoted(field) + ", must be one of " + join({kWrenchFields.begin(), kWrenchFields.end()}));
  return {name, topic, static_cast<std::size_t>(found - kWrenchFields.begin())};
}

/// One IMU for two places would be two struts, or a wheel and a body, that always move alike; so would one force for
/// two.
void checkTopics(const VehicleLayout& layout) {
  std::map<std::string, std::string> users;
  const auto use = [&](const std::string& topic, const std::string& user) {
    checkTopic(user, topic);
    const auto [other, is_first] = users.emplace(topic, user);
    if (!is_first)
      refuse(user + quoted(topic) + " is the topic of " + other->second +
             " too, must be another; one IMU for several struts is a body_imu, and each has a position");
  };
  if (layout.body_imu) use(*layout.body_imu, "body_imu");
  for (const VehicleLayout::Strut& strut : layout.struts) {
    if (strut.sprung_imu) use(*strut.sprung_imu, "struts/" + strut.name + "/sprung_imu");
    use(strut.unsprung_imu, "struts/" + strut.name + "/unsprung_imu");
  }
  std::map<std::pair<std::string, std::size_t>, std::string> forces;
  for (const VehicleLayout::KnownForce& force : layout.known_forces) {
    const std::string where = "known_forces/" + force.name;
    if (const auto imu = users.find(force.topic); imu != users.end())
      refuse(where + "/topic" + quoted(force.topic) + " is the topic of " + imu->second + ", must be that of a force");
    const auto [other, is_first] = forces.emplace(std::pair(force.topic, force.field), where);
    if (!is_first) refuse(where + " has topic and field of " + other->second + ", must be another force");
  }
}

}  // namespace

void VehicleLayout::turn(const Eigen::Matrix3d& mount) {
  for (Strut& strut : struts)
    if (strut.position) Eigen::Map<Eigen::Vector3d>(strut.position->data()).applyOnTheLeft(mount);
}

// Of two struts in one place the body's IMU says the same, whatever the body does.
void requireApart(const VehicleLayout& layout) {
  for (auto strut = layout.struts.begin(); strut != layout.struts.end(); ++strut)
    for (auto other = layout.struts.begin(); other != strut; ++other)
      if (strut->position && other->position &&
          std::hypot((*strut->position)[0] - (*other->position)[0], (*strut->position)[1] - (*other->position)[1]) <
              kVehicleTuning.nearest)
        refuse("struts/" + strut->name + (strut->frame ? "/frame" : "/position") + " is where struts/" + other->name +
               " is, must be another x or y: it is where the strut meets the body");
}

VehicleLayout VehicleLayout::ofOneStrut(bool has_road) {
  VehicleLayout layout;
  layout.struts.push_back({"", "unsprung/imu", "sprung/imu", {}, {}});
  if (has_road) layout.road_imu = "road/imu";
  return layout;
}

VehicleLayout takeVehicle(OptionMap& values) {
  VehicleLayout layout;
  const std::map<std::string, OptionMap> struts = takeGroups(values, "struts"),
                                         known_forces = takeGroups(values, "known_forces");
  const auto [body_imu] = takeTexts("", std::exchange(values, {}), {"body_imu"}, {"struts", "known_forces"});
  if (!body_imu.empty()) layout.body_imu = body_imu;
  for (const auto& [name, settings] : struts)
    layout.struts.push_back(toStrut(name, settings, layout.body_imu.has_value()));
  for (const auto& [name, settings] : known_forces) layout.known_forces.push_back(toForce(name, settings));
  if (struts.empty()) refuse("struts are missing: a vehicle has struts, each with NAME: {unsprung_imu: TOPIC, ...}");
  checkNumber("struts", layout.struts.size(), kMostStruts);
  checkNumber("known_forces", layout.known_forces.size(), kMostKnownForces);
  checkTopics(layout);
  requireApart(layout);
  return layout;
}

VehicleStreams::VehicleStreams(const VehicleLayout& layout) {
  const auto add = [&](const std::string& topic, Place place, std::size_t count, const std::string& setting) {
    sensors.push_back({topic, place, options.size(), count, channels.struts.size(), setting});
    options.insert(options.end(), count, StreamOptions{sensors.size() - 1, place != Place::kRoad});
    return sensors.back().stream;
  };
  const bool needs_body = std::any_of(layout.struts.begin(), layout.struts.end(),
                                      [](const VehicleLayout::Strut& strut) { return !strut.sprung_imu; });
  if (needs_body) {
    if (!layout.body_imu) throw std::invalid_argument("body_imu is missing: a strut has no sprung_imu");
    channels.body_imu = add(*layout.body_imu, Place::kBody, 2 * 3, "body_imu");
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
  channels.known_forces.resize(layout.known_forces.size());
  for (const VehicleLayout::KnownForce& first : layout.known_forces) {
    const auto has_it = [&](const Sensor& each) { return each.place == Place::kForce && each.topic == first.topic; };
    if (std::any_of(sensors.begin(), sensors.end(), has_it)) continue;
    Sensor& sensor = sensors.emplace_back(
        Sensor{first.topic, Place::kForce, options.size(), 0, 0, "known_forces/" + first.name + "/topic"});
    for (std::size_t k = 0; k < layout.known_forces.size(); ++k) {
      if (layout.known_forces[k].topic != first.topic) continue;
      sensor.fields.push_back(layout.known_forces[k].field);
      sensor.forces.push_back(k);
      channels.known_forces[k] = options.size();
      options.push_back({sensors.size() - 1, true, true});
    }
    sensor.count = sensor.forces.size();
  }
}

void requireNumStruts(std::size_t count) {
  if (count < 1 || count > static_cast<std::size_t>(kMostStruts))
    throw std::invalid_argument(std::to_string(count) + " struts, must be 1 to " + std::to_string(kMostStruts));
}

void requireNumKnownForces(std::size_t count) {
  if (count > static_cast<std::size_t>(kMostKnownForces))
    throw std::invalid_argument(std::to_string(count) + " known forces, must be at most " +
                                std::to_string(kMostKnownForces));
}

}  // namespace suspension_health_monitor
