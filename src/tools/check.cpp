#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "../ros/conversions.h"
#include "../ros/vehicle_sensors.h"
#include "bag_file.h"
#include "bag_options.h"
#include "command.h"
#include "results.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/vehicle/body_over_wheel.h"
#include "suspension_health_monitor/internal/vehicle/imu_spectra.h"
#include "suspension_health_monitor/internal/vehicle/imu_survey.h"
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

/// @return the place of the largest component, of either sign: 0 x, 1 y, 2 z.
int largestOf(const Eigen::Vector3d& v) {
  int axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// What the command check knows of a topic.
struct CheckedImu {
  std::string topic;
  ImuSurvey survey = {};
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< of its axes the one that points up, with its sign
  bool by_gravity = false;                        ///< else `up` is the axis that moves most, of either sign
  bool has_gyro = false;

  int axis() const { return largestOf(up); }
  /// @return one of kAxisNames.
  std::string upAxis() const { return (up[axis()] < 0.0 ? "-" : "") + std::string(1, "xyz"[axis()]); }
};

/// The IMUs of bags: what each of them is like, what points up, and which is which.
struct CheckedImus {
  /// @param asked  topics of IMUs; none: all of a bag are meant.
  /// @param target_frame  whose axes count instead of the IMUs' own; empty: none. The bags have the transforms.
  /// @throws InputError  as readTopics(), or without any IMU.
  CheckedImus(const ImuBags& bags, const std::vector<BagTopic>& asked, const std::string& target_frame = "");

  /// @return what is the matter with an IMU and what to do, in a sentence; empty: nothing is.
  std::string faultOf(std::size_t i) const {
    return describeFault(imus[i].survey, imus[i].axis(), std::hypot(moved(i, kBands[1]), moved(i, kBands[2])));
  }
  std::string sentenceOf(const BodyOverWheel& pair) const {
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
  json toJson() const;

  std::vector<CheckedImu> imus;
  TopicGaps gaps{ShellOptions().input_timeout};
  std::vector<BodyOverWheel> pairs;

 private:
  std::size_t placeOf(const std::string& topic) {
    const auto found =
        std::find_if(imus.begin(), imus.end(), [&](const CheckedImu& each) { return each.topic == topic; });
    const auto place = static_cast<std::size_t>(found - imus.begin());
    if (place == imus.size()) imus.push_back({topic});
    return place;
  }
  void orient();
  double moved(std::size_t i, const double (&band)[2]) const { return spectra->rms(i, imus[i].up, band[0], band[1]); }

  std::optional<ImuSpectra> spectra;
};

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
    imu.up = gravity ? (gravity->is_negative ? -1.0 : 1.0) * Eigen::Vector3d::Unit(gravity->axis)
                     : Eigen::Vector3d(Eigen::Vector3d::Unit(largestOf(moves)));
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
  for (const std::string option : {"sprung-topic", "unsprung-topic"}) {
    if (values.count(option) == 0) continue;
    if (values.count(kVehicle) != 0) throw std::invalid_argument("--" + option + " beside --vehicle, must be left out");
    topics.push_back({values[option].as<std::string>(), "--" + option});
  }
  if (values.count(kVehicle) == 0 && topics.size() == 1)
    throw std::invalid_argument(topics[0].named_by + " alone, must come with the other topic");
  return topics;
}

void print(const CheckedImus& checked) {
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
    if (imu.survey.tellsGravity() && !imu.survey.gravity()) without_gravity.push_back(imu.topic);
  if (!without_gravity.empty())
    std::printf("No gravity in %s: up is the axis that moves most, and its sign fits that of its pair.\n",
                join(without_gravity).c_str());
  checked.gaps.print();
  std::printf("\n");
  for (const BodyOverWheel& pair : checked.pairs) std::printf("%s\n", checked.sentenceOf(pair).c_str());
}

/// @return the name of the strut over a wheel: the corner, if it is in this wheel's topic alone; else the topic's.
std::string nameOf(const std::string& topic, const CheckedImus& checked) {
  for (const std::string_view corner : kCornerNames) {
    const auto isAt = [&](const std::string& other) { return other.find(corner) != std::string::npos; };
    const auto isOther = [&](const BodyOverWheel& pair) {
      return checked.imus[pair.wheel].topic != topic && isAt(checked.imus[pair.wheel].topic);
    };
    if (isAt(topic) && std::none_of(checked.pairs.begin(), checked.pairs.end(), isOther)) return std::string(corner);
  }
  std::string name = topic.substr(topic.find_first_not_of('/'));
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

/// @return whether all bodies, and all wheels, are mounted alike.
bool areAlike(const CheckedImus& checked) {
  const std::vector<CheckedImu>& imus = checked.imus;
  const BodyOverWheel& first = checked.pairs.front();
  return std::all_of(checked.pairs.begin(), checked.pairs.end(), [&](const BodyOverWheel& pair) {
    return imus[pair.body].upAxis() == imus[first.body].upAxis() &&
           imus[pair.wheel].upAxis() == imus[first.wheel].upAxis();
  });
}

std::string vehicleOf(const CheckedImus& checked) {
  std::string body, struts;
  for (const BodyOverWheel& pair : checked.pairs) {
    const std::string &top = checked.imus[pair.body].topic, &wheel = checked.imus[pair.wheel].topic;
    if (!pair.is_own) body = "body_imu: " + top + "\n";
    struts += "  " + nameOf(wheel, checked) + ": {" + (pair.is_own ? "sprung_imu: " + top + ", " : "") +
              "unsprung_imu: " + wheel;
    struts += pair.is_own ? "}\n" : "}   # fill in: position: [x, y, z] of the strut's top from the body's IMU [m]\n";
  }
  std::string text = body + "struts:\n" + struts;
  if (!areAlike(checked))
    text += "# The IMUs are not mounted alike: give static transforms and target_frame (doc/conventions.md).\n";
  return text;
}

/// @return `suspension_bag identify` with the bags and all that the pairs need.
/// @param file  that --write names, or a name for it.
std::string nextCommand(const CheckedImus& checked, const std::vector<std::string>& bags, const std::string& file) {
  const BodyOverWheel& first = checked.pairs.front();
  const CheckedImu &body = checked.imus[first.body], &wheel = checked.imus[first.wheel];
  const std::string sensors = checked.pairs.size() > 1
                                  ? " --vehicle " + file
                                  : " --sprung-topic " + body.topic + " --unsprung-topic " + wheel.topic;
  std::string command = "rosrun suspension_health_monitor suspension_bag identify " + join(bags, " ") + sensors;
  if (!areAlike(checked)) return command;
  if (body.upAxis() != "z") command += " --set sprung_axis=" + body.upAxis();
  if (wheel.upAxis() != "z") command += " --set unsprung_axis=" + wheel.upAxis();
  return command;
}

/// @return the text of --write: of one strut settings, of several a vehicle file.
std::string fileOf(const CheckedImus& checked, const std::vector<std::string>& bags, const std::string& file) {
  const std::string head = "# suspension_bag check has found this.\n# " + nextCommand(checked, bags, file) + "\n";
  if (checked.pairs.size() > 1) return head + vehicleOf(checked);
  const BodyOverWheel& only = checked.pairs.front();
  const CheckedImu &body = checked.imus[only.body], &wheel = checked.imus[only.wheel];
  return head + "# roslaunch suspension_health_monitor monitor.launch config:=" + file + " sprung_imu:=" + body.topic +
         " unsprung_imu:=" + wheel.topic + "\nsprung_axis: \"" + body.upAxis() + "\"\nunsprung_axis: \"" +
         wheel.upAxis() + "\"\n";
}

void checkBags(const po::variables_map& values) {
  std::optional<TextFile> written = outputFile(values, "write"), findings = outputFile(values, "json");

  const ImuBags bags = bagsOf(values);
  const CheckedImus checked(bags, topicsOf(values));
  print(checked);
  if (findings) findings->commit(checked.toJson().dump(2) + '\n');
  if (checked.pairs.empty())
    throw TooLittleError(
        "no IMU moves like a body over another one: drive for half a minute on a rough road, with one IMU on the wheel "
        "carrier and one on the body above it, whose clocks agree to 40 ms");
  const std::string file = values.count("write") != 0 ? values["write"].as<std::string>() : "my_vehicle.yaml";
  if (written) written->commit(fileOf(checked, bags.paths, file));
  const bool has_file = checked.pairs.size() == 1 || written.has_value();
  std::printf("\nNext%s: %s\n", has_file ? "" : ", with the file of --write",
              nextCommand(checked, bags.paths, file).c_str());
  printWritten(values, {"write", "json"});
}

}  // namespace

json dataJson(const BagOptions& options) {
  std::vector<BagTopic> topics;
  for (const BagTopic& topic : options.bags.topics)
    if (!topic.is_force) topics.push_back(topic);
  return CheckedImus(options.bags, topics, options.settings.common.shell.target_frame).toJson();
}

void check(const Arguments& arguments) {
  po::options_description description("options");
  addBags(description);
  auto add = description.add_options();
  add(kVehicle, po::value<std::string>(), "check the IMUs of this vehicle file");
  add("sprung-topic", po::value<std::string>(), "check this Imu topic of the body and that of the wheel carrier");
  add("unsprung-topic", po::value<std::string>(), "Imu topic of the wheel carrier; without any all in the bags");
  add("write", po::value<std::string>(), "YAML file for the other commands: settings of a strut, or a vehicle file");
  runOnBags(arguments, "check BAG... [--vehicle FILE | --sprung-topic T --unsprung-topic T] [OPTION]...", description,
            {"write", "json"}, &checkBags);
}

}  // namespace suspension_health_monitor
