#include "checked_imus.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "../ros/conversions.h"
#include "../ros/vehicle_sensors.h"
#include "bag_file.h"
#include "command.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kFewestBlocks = 3.0;  // that show a spectrum: 16 s

/// Bands of the body's slow motion, of its bounce, and of the wheel [Hz].
constexpr double kBands[][2] = {{0.25, 0.5}, {0.5, 3.0}, {3.0, 20.0}};

std::vector<BagTopic> allTopicsOf(const std::string& path) {
  std::vector<std::string> names = topicsWith<sensor_msgs::Imu>(BagFile(path));
  std::sort(names.begin(), names.end());
  return mapped(names, [](const std::string& name) { return BagTopic{name, "the bag"}; });
}

}  // namespace

int CheckedImu::axis() const {
  int axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  return axis;
}

CheckedImus::CheckedImus(const ImuBags& bags, const std::vector<BagTopic>& asked, const std::string& target_frame) {
  std::vector<ImuBags> each;
  for (const std::string& path : bags.paths) {
    each.push_back(bags.of(path, gaps));
    each.back().topics = asked.empty() ? allTopicsOf(path) : asked;
    for (const BagTopic& topic : each.back().topics) placeOf(topic.name);
  }
  if (imus.empty()) throw InputError(join(bags.paths) + ": no topic of sensor_msgs/Imu");
  spectra.emplace(imus.size());
  for (const ImuBags& bag : each) {
    std::vector<std::size_t> places;
    std::vector<ImuMount> mounts;
    for (const BagTopic& topic : bag.topics) {
      places.push_back(placeOf(topic.name));
      mounts.emplace_back("z", target_frame, std::nullopt, bag.transforms.get());
    }
    const auto take = [&, along = std::vector<double>()](std::size_t topic, const sensor_msgs::Imu& message,
                                                         Stamp) mutable {
      CheckedImu& imu = imus[places[topic]];
      if (const auto refused = mounts[topic].read(message, false, along)) {
        if (*refused == RejectReason::kNotMeasured) imu.survey.addNotMeasured();
        return true;
      }
      along.clear();
      const std::array<double, 3> a = mounts[topic].turned(message.linear_acceleration);
      const std::array<double, 3> rate = mounts[topic].turned(message.angular_velocity);
      imu.has_gyro =
          imu.has_gyro || (message.angular_velocity_covariance[0] != -1.0 && rate != std::array<double, 3>{});
      SixAxes all = SixAxes::Zero();
      all.head<3>() << a[0], a[1], a[2];
      imu.survey.add(toStamp(message.header.stamp), all.head<3>());
      if (imu.has_gyro) all.tail<3>() << rate[0], rate[1], rate[2];
      spectra->push(places[topic], toStamp(message.header.stamp), all);
      return true;
    };
    if (!bag.topics.empty()) readTopics(bag, {take, {}});
    spectra->restart();
    for (CheckedImu& imu : imus) imu.survey.restart();
  }
  orient();
}

std::size_t CheckedImus::placeOf(const std::string& topic) {
  const auto found =
      std::find_if(imus.begin(), imus.end(), [&](const CheckedImu& each) { return each.topic == topic; });
  const auto place = static_cast<std::size_t>(found - imus.begin());
  if (place == imus.size()) imus.push_back({topic});
  return place;
}

double CheckedImus::moved(std::size_t i, const double (&band)[2]) const {
  return spectra->rms(i, imus[i].up, band[0], band[1]);
}

std::string CheckedImus::faultOf(std::size_t i) const {
  return describeFault(imus[i].survey, imus[i].axis(), std::hypot(moved(i, kBands[1]), moved(i, kBands[2])));
}

void CheckedImus::orient() {
  std::vector<double> rates;
  std::vector<bool> has_gyro;
  std::vector<Eigen::Vector3d> ups;
  for (std::size_t i = 0; i < imus.size(); ++i) {
    CheckedImu& imu = imus[i];
    const auto gravity = imu.survey.isKnown() ? imu.survey.gravity() : std::nullopt;
    imu.by_gravity = gravity.has_value();
    Eigen::Vector3d moves;
    for (int axis = 0; axis < 3; ++axis)
      moves[axis] = spectra->rms(i, Eigen::Vector3d::Unit(axis), kBands[1][0], kBands[2][1]);
    int axis = 0;
    moves.maxCoeff(&axis);
    imu.up = gravity ? (gravity->is_negative ? -1.0 : 1.0) * Eigen::Vector3d::Unit(gravity->axis)
                     : Eigen::Vector3d(Eigen::Vector3d::Unit(axis));
    const bool is_known = imu.survey.isKnown() && spectra->blocks(i) >= kFewestBlocks;
    ups.push_back(is_known ? imu.up : Eigen::Vector3d::Zero());
    rates.push_back(is_known ? imu.survey.rate() : HUGE_VAL);
    has_gyro.push_back(imu.has_gyro && is_known);
  }
  pairs = findBodiesOverWheels(spectra->along(ups, has_gyro, rates));
  // Of two IMUs against each other the one turns that gravity says nothing of, with all that it belongs to.
  for (const BodyOverWheel& first : std::vector<BodyOverWheel>(pairs)) {
    if (!first.is_reversed || imus[first.body].by_gravity || !imus[first.wheel].by_gravity) continue;
    imus[first.body].up *= -1.0;
    imus[first.body].by_gravity = true;
    for (BodyOverWheel& pair : pairs)
      if (pair.body == first.body) pair.is_reversed = !pair.is_reversed;
  }
  for (BodyOverWheel& pair : pairs) {
    if (!pair.is_reversed || imus[pair.wheel].by_gravity) continue;
    imus[pair.wheel].up *= -1.0;
    pair.is_reversed = false;
  }
}

std::string CheckedImus::sentenceOf(const BodyOverWheel& pair) const {
  std::string text = imus[pair.body].topic + " moves like the body over wheel " + imus[pair.wheel].topic +
                     formatted(": %.0f %% of its motion by all wheels found", 100.0 * pair.explained);
  if (pair.is_own)
    text += formatted(", bounce about %.2f Hz, damping ratio about %.2f, delay %+.1f ms",
                      std::sqrt(pair.stiffness_to_mass) / (2.0 * M_PI),
                      pair.damping_to_mass / (2.0 * std::sqrt(pair.stiffness_to_mass)), 1e3 * pair.delay);
  if (pair.is_reversed)
    text += "; gravity says that both point up, their motion that one is reversed: its sign is wrong";
  return text;
}

json CheckedImus::toJson() const {
  json whole{{"topics", json::array()}, {"pairs", json::array()}, {"silent", gaps.toJson()}};
  for (std::size_t i = 0; i < imus.size(); ++i) {
    const CheckedImu& imu = imus[i];
    const std::string fault = faultOf(i);
    json each{{"topic", imu.topic}, {"messages", imu.survey.messages()}, {"verdict", fault.empty() ? "OK" : fault}};
    if (imu.survey.isKnown()) {
      each["rate"] = imu.survey.rate();
      each["jitter"] = imu.survey.jitter();
      each["lost"] = imu.survey.lost();
      each["rejected"] = imu.survey.rejected(imu.axis()).byName();
      each["up_axis"] = imu.upAxis();
      each["up_axis_by"] = imu.survey.gravity() ? "gravity" : "motion";
      each["noise"] = imu.survey.noise(imu.axis());
      each["largest"] = imu.survey.largest(imu.axis());
      if (const auto gravity = imu.survey.gravity()) each["gravity"] = gravity->size, each["lean"] = gravity->lean;
      for (const auto& band : kBands)
        each["rms"].push_back({{"from", band[0]}, {"to", band[1]}, {"rms", moved(i, band)}});
    }
    whole["topics"].push_back(std::move(each));
  }
  for (const BodyOverWheel& pair : pairs) {
    json each{{"body", imus[pair.body].topic}, {"wheel", imus[pair.wheel].topic}, {"own", pair.is_own},
              {"reversed", pair.is_reversed},  {"explained", pair.explained},     {"sentence", sentenceOf(pair)}};
    if (pair.is_own)
      each.update({{"damping_to_mass", pair.damping_to_mass},
                   {"stiffness_to_mass", pair.stiffness_to_mass},
                   {"delay", pair.delay}});
    whole["pairs"].push_back(std::move(each));
  }
  return whole;
}

json dataJson(const BagOptions& options) {
  std::vector<BagTopic> topics;
  for (const BagTopic& topic : options.bags.topics)
    if (!topic.is_force) topics.push_back(topic);
  return CheckedImus(options.bags, topics, options.settings.common.shell.target_frame).toJson();
}

}  // namespace suspension_health_monitor
