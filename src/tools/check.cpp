#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bag_options.h"
#include "checked_imus.h"
#include "command.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"

namespace suspension_health_monitor {
namespace {

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
  if (checked.imus.size() < 2)
    throw TooLittleError("one IMU is not enough: record two, one on the body and one on the wheel carrier");
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
