#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "../ros/conversions.h"
#include "bag_file.h"
#include "bag_options.h"
#include "checked_files.h"
#include "command.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/wording/imu_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;
using nlohmann::json;

constexpr double kFewestBlocks = 3.0;  // that show a spectrum: 16 s

/// Bands of the body's slow motion, of its bounce, and of the wheel [Hz].
constexpr double kBands[][2] = {{0.25, 0.5}, {0.5, 3.0}, {3.0, 20.0}};

/// The topics of --vehicle, or of --sprung-topic and --unsprung-topic; none: all of a bag are meant.
std::vector<BagTopic> topicsOf(const po::variables_map& values) {
  std::vector<BagTopic> topics;
  if (values.count(kVehicle) != 0) {
    const VehicleLayout layout = readVehicleFile(values[kVehicle].as<std::string>());
    const auto add = [&](const std::string& topic, const std::string& setting) { topics.push_back({topic, setting}); };
    if (layout.body_imu) add(*layout.body_imu, "body_imu");
    for (const VehicleLayout::Strut& strut : layout.struts) {
      if (strut.sprung_imu) add(*strut.sprung_imu, "struts/" + strut.name + "/sprung_imu");
      add(strut.unsprung_imu, "struts/" + strut.name + "/unsprung_imu");
    }
  }
  for (const std::string option : {"--sprung-topic", "--unsprung-topic"})
    if (const std::string name = option.substr(2); values.count(name) != 0) {
      if (values.count(kVehicle) != 0) throw std::invalid_argument(option + " beside --vehicle, must be left out");
      topics.push_back({values[name].as<std::string>(), option});
    }
  if (values.count(kVehicle) == 0 && topics.size() == 1)
    throw std::invalid_argument(topics[0].named_by + " alone, must come with the other topic");
  return topics;
}

std::vector<BagTopic> allTopicsOf(const std::string& path) {
  std::map<std::string, BagTopic> topics;
  const BagFile file(path);
  for (const BagConnection& connection : file.connections())
    if (carries<sensor_msgs::Imu>(connection)) topics[connection.topic] = {connection.topic, "the bag"};
  std::vector<BagTopic> list;
  for (const auto& [name, topic] : topics) list.push_back(topic);
  return list;
}

/// What is read of the bags.
struct Checked {
  std::vector<CheckedImu> imus;
  std::optional<ImuSpectra> spectra;
  TopicGaps gaps{ShellOptions().input_timeout};
  std::vector<BodyOverWheel> pairs;

  void read(ImuBags bags, const std::vector<BagTopic>& asked);
  void orient();
  double moved(std::size_t i, const double (&band)[2]) const { return spectra->rms(i, imus[i].up, band[0], band[1]); }
  std::string faultOf(std::size_t i) const {
    return describeFault(imus[i].survey, imus[i].axis(), std::hypot(moved(i, kBands[1]), moved(i, kBands[2])));
  }

 private:
  std::size_t placeOf(const std::string& topic) {
    const auto found =
        std::find_if(imus.begin(), imus.end(), [&](const CheckedImu& each) { return each.topic == topic; });
    if (found == imus.end()) imus.push_back({topic});
    return found == imus.end() ? imus.size() - 1 : static_cast<std::size_t>(found - imus.begin());
  }
};

void Checked::read(ImuBags bags, const std::vector<BagTopic>& asked) {
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
    for (const BagTopic& topic : bag.topics) places.push_back(placeOf(topic.name));
    const auto take = [&](std::size_t topic, const sensor_msgs::Imu& message, Stamp) {
      CheckedImu& imu = imus[places[topic]];
      if (message.linear_acceleration_covariance[0] == -1.0) return imu.survey.addNotMeasured(), true;
      const auto& a = message.linear_acceleration;
      const Eigen::Vector3d reading(a.x, a.y, a.z);
      const auto& rate = message.angular_velocity;
      imu.has_gyro = imu.has_gyro || (message.angular_velocity_covariance[0] != -1.0 &&
                                      (rate.x != 0.0 || rate.y != 0.0 || rate.z != 0.0));
      imu.survey.add(toStamp(message.header.stamp), reading);
      SixAxes all = SixAxes::Zero();
      all.head<3>() = reading;
      if (imu.has_gyro) all.tail<3>() << rate.x, rate.y, rate.z;
      spectra->push(places[topic], toStamp(message.header.stamp), all);
      return true;
    };
    if (!bag.topics.empty()) readTopics(bag, {take, {}});
    spectra->restart();
    for (CheckedImu& imu : imus) imu.survey.restart();
  }
}

/// Finds what points up, and which IMU is which.
void Checked::orient() {
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
  pairs = findBodiesOverWheels(spectra->along(ups, has_gyro), rates);
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

std::string sentenceOf(const BodyOverWheel& pair, const Checked& checked) {
  std::string text = checked.imus[pair.body].topic + " moves like the body over wheel " +
                     checked.imus[pair.wheel].topic +
                     formatted(": %.0f %% of its motion by all wheels found", 100.0 * pair.explained);
  if (pair.is_own)
    text += formatted(", bounce about %.2f Hz, damping ratio about %.2f, delay %+.1f ms",
                      std::sqrt(pair.stiffness_to_mass) / (2.0 * M_PI),
                      pair.damping_to_mass / (2.0 * std::sqrt(pair.stiffness_to_mass)), 1e3 * pair.delay);
  if (pair.is_reversed)
    text += "; gravity says that both point up, their motion that one is reversed: its sign is wrong";
  return text;
}

void print(const Checked& checked) {
  std::size_t width = 5;
  for (const CheckedImu& imu : checked.imus) width = std::max(width, imu.topic.size());
  const int w = static_cast<int>(width);
  std::printf("%-*s  rate [Hz]  lost   up  gravity  lean [deg]  noise <=  largest [m/s^2]  verdict\n", w, "topic");
  for (std::size_t i = 0; i < checked.imus.size(); ++i) {
    const CheckedImu& imu = checked.imus[i];
    const std::string fault = checked.faultOf(i);
    std::printf("%-*s  ", w, imu.topic.c_str());
    if (imu.survey.isKnown()) {
      const auto gravity = imu.survey.gravity();
      std::printf("%9.1f  %4s  %3s  %7s  %10s  %8.3g  %15.1f  ", imu.survey.rate(), percent(imu.survey.lost()).c_str(),
                  imu.upAxis().c_str(), gravity ? formatted("%.2f", gravity->size).c_str() : "none",
                  gravity ? formatted("%.0f", gravity->lean / M_PI * 180.0).c_str() : "-", imu.survey.noise(imu.axis()),
                  imu.survey.largest(imu.axis()));
    }
    std::printf("%s\n", fault.empty() ? "OK" : fault.c_str());
  }
  std::vector<std::string> without_gravity;
  for (const CheckedImu& imu : checked.imus)
    if (imu.survey.isKnown() && !imu.survey.gravity()) without_gravity.push_back(imu.topic);
  if (!without_gravity.empty())
    std::printf("No gravity in %s: up is the axis that moves most, and its sign fits that of its pair.\n",
                join(without_gravity).c_str());
  checked.gaps.print();
  std::printf("\n");
  for (const BodyOverWheel& pair : checked.pairs) std::printf("%s\n", sentenceOf(pair, checked).c_str());
}

json toJson(const Checked& checked) {
  json whole{{"topics", json::array()}, {"pairs", json::array()}, {"silent", checked.gaps.toJson()}};
  for (std::size_t i = 0; i < checked.imus.size(); ++i) {
    const CheckedImu& imu = checked.imus[i];
    const std::string fault = checked.faultOf(i);
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
        each["rms"].push_back({{"from", band[0]}, {"to", band[1]}, {"rms", checked.moved(i, band)}});
    }
    whole["topics"].push_back(std::move(each));
  }
  for (const BodyOverWheel& pair : checked.pairs) {
    json each{{"body", checked.imus[pair.body].topic},
              {"wheel", checked.imus[pair.wheel].topic},
              {"own", pair.is_own},
              {"reversed", pair.is_reversed},
              {"explained", pair.explained}};
    if (pair.is_own)
      each.update({{"damping_to_mass", pair.damping_to_mass},
                   {"stiffness_to_mass", pair.stiffness_to_mass},
                   {"delay", pair.delay}});
    whole["pairs"].push_back(std::move(each));
  }
  return whole;
}

}  // namespace

void check(const Arguments& arguments) {
  po::options_description description("options");
  addBags(description);
  auto add = description.add_options();
  add(kVehicle, po::value<std::string>(), "check the IMUs of this vehicle file");
  add("sprung-topic", po::value<std::string>(), "check this Imu topic of the body and that of the wheel carrier");
  add("unsprung-topic", po::value<std::string>(), "Imu topic of the wheel carrier; without any all in the bags");
  add("write", po::value<std::string>(), "YAML file for the other commands: settings of a strut, or a vehicle file");
  const auto values = parse(
      arguments, "check BAG... [--vehicle FILE | --sprung-topic T --unsprung-topic T] [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", kVehicle}, {"write", "json"});
  std::optional<TextFile> written = outputFile(*values, "write"), findings = outputFile(*values, "json");

  const ImuBags bags = bagsOf(*values);
  Checked checked;
  checked.read(bags, topicsOf(*values));
  checked.orient();
  print(checked);
  if (findings) findings->commit(toJson(checked).dump(2) + '\n');
  if (checked.pairs.empty())
    throw TooLittleError(
        "no IMU moves like a body over another one: drive for half a minute on a rough road, with one IMU on the wheel "
        "carrier and one on the body above it, whose clocks agree to 40 ms");
  const std::string file = values->count("write") != 0 ? (*values)["write"].as<std::string>() : "my_vehicle.yaml";
  if (written) written->commit(fileOf(checked.imus, checked.pairs, bags.paths, file));
  const bool has_file = checked.pairs.size() == 1 || written.has_value();
  std::printf("\nNext%s: %s\n", has_file ? "" : ", with the file of --write",
              nextCommand(checked.imus, checked.pairs, bags.paths, file).c_str());
  printWritten(*values, {"write", "json"});
}

}  // namespace suspension_health_monitor
