#include "bag_options.h"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <thread>

#include "../ros/model_file.h"
#include "../ros/vehicle_sensors.h"
#include "bag_file.h"
#include "long_work.h"
#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

/// @return the static transforms (/tf_static) of all bags.
/// @throws InputError  naming the bag: unreadable, or no tf2_msgs/TFMessage in it on that topic.
std::shared_ptr<const tf2::BufferCore> readStaticTransforms(const std::vector<std::string>& paths) {
  constexpr const char* kTopic = "/tf_static";
  const auto transforms = std::make_shared<tf2::BufferCore>();
  ChunkContents contents;
  tf2_msgs::TFMessage tree;
  for (const std::string& path : paths) {
    BagFile file(path);
    const std::vector<std::uint32_t> connections = connectionsOf<tf2_msgs::TFMessage>(file, kTopic);
    if (connections.empty())
      throw InputError(path + ": no topic " + kTopic + ", needed since target_frame or the frame of a strut is set");
    const auto is_wanted = [&](std::uint32_t connection) {
      return std::find(connections.begin(), connections.end(), connection) != connections.end();
    };
    for (const BagChunk& chunk : file.chunks()) {
      if (std::none_of(chunk.connections.begin(), chunk.connections.end(), is_wanted)) continue;
      file.read(chunk, contents);
      for (const BagMessage& message : contents.messages) {
        if (!is_wanted(message.connection)) continue;
        decode(file, message, std::string(" on ") + kTopic, tree);
        for (const geometry_msgs::TransformStamped& transform : tree.transforms)
          transforms->setTransform(transform, path, true);
      }
    }
  }
  return transforms;
}

VehicleLayout layoutOfTopics(const po::variables_map& values) {
  std::vector<std::string> topics;
  for (const std::string option : kTopicOptions) {
    if (values.count(option) == 0) continue;
    topics.push_back(values[option].as<std::string>());
    if (topics.back().empty()) throw std::invalid_argument("--" + option + " is empty, must be a topic");
  }
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

/// Makes nominal values of the numbers of a model that diagnose -o has written.  @return false: it is none.
bool toNominal(OptionMap& settings) {
  constexpr const char *kDamping = "damping_to_mass", *kStiffness = "stiffness_to_mass";
  if (settings.count(kDamping) == 0 || settings.count(kStiffness) == 0) return false;
  settings.erase("complete");
  for (const char* number : {kDamping, kStiffness}) {
    settings.insert({std::string("nominal/") + number, settings.at(number)});
    settings.erase(number);
  }
  for (const char* of_model : {"effects", "readings"}) takePrefixed(settings, of_model);
  return true;
}

}  // namespace

void addBags(po::options_description& description) {
  auto add = description.add_options();
  add("bag", po::value<std::vector<std::string>>()->required(), "bags, read one after the other");
  add("start", po::value<double>()->default_value(0.0), "[s] after the beginning of each bag");
  add("end", po::value<double>(), "[s] after the beginning of each bag (its end)");
  add("json", po::value<std::string>(), "write the result as JSON");
}

ImuBags bagsOf(const po::variables_map& values) {
  ImuBags bags;
  bags.paths = values["bag"].as<std::vector<std::string>>();
  bags.start = values["start"].as<double>();
  if (values.count("end") != 0) bags.end = values["end"].as<double>();
  if (!(bags.start >= 0.0 && bags.end > bags.start))
    throw std::invalid_argument("--start " + numberText(bags.start) + " --end " + numberText(bags.end) +
                                " [s], must be 0 <= start < end");
  return bags;
}

po::options_description bagOptions() {
  po::options_description description("options");
  addBags(description);
  auto add = description.add_options();
  add("config", po::value<std::string>()->default_value(""),
      "YAML file like config/monitor.yaml, or a model that diagnose -o has written");
  add("set", po::value<std::vector<std::string>>()->default_value({}, "")->composing(),
      "NAME=VALUE: any option of `suspension_bag options monitor`");
  add("sprung-topic", po::value<std::string>()->default_value("/sprung/imu"), "Imu topic of the body");
  add("unsprung-topic", po::value<std::string>()->default_value("/unsprung/imu"), "Imu topic of the wheel carrier");
  add("road-topic", po::value<std::string>(), "Imu topic of the road under the tyre: identifies the tyre, too");
  add("threads", po::value<int>()->default_value(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))),
      "processor cores to use");
  add(kVehicle, po::value<std::string>(),
      "YAML file with the IMUs of a whole vehicle, instead of the topics of a strut");
  add(kStrut, po::value<std::string>(), "of the vehicle: results, and files, of this one only");
  return description;
}

void runOnBags(const Arguments& arguments, const std::string& usage, const po::options_description& options,
               const std::vector<std::string>& outputs, void (*work)(const po::variables_map& values)) {
  const auto values = parse(arguments, usage, options, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", kVehicle, "config", kBaseline, kAgainst, kEffectsFile, kModel}, outputs);
  const Interruption interruption;
  work(*values);
}

AskedVehicle readVehicle(const po::variables_map& values) {
  const std::string strut = values.count(kStrut) != 0 ? values[kStrut].as<std::string>() : "";
  if (values.count(kVehicle) == 0) {
    if (values.count(kStrut) != 0)
      throw std::invalid_argument("--strut " + strut + " without --vehicle, which it is of");
    return {layoutOfTopics(values), "", {""}, {0}, 0};
  }
  for (const std::string option : kTopicOptions)
    if (values.count(option) != 0 && !values[option].defaulted())
      throw std::invalid_argument("--" + option + " beside --vehicle, must be left out");
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

int threadsOf(const po::variables_map& values) {
  const int threads = values["threads"].as<int>();
  if (threads < 1 || threads > 1024)
    throw std::invalid_argument("--threads " + std::to_string(threads) + ", must be in [1, 1024]");
  return threads;
}

OptionMap givenSettings(const po::variables_map& values) {
  OptionMap settings = gatherOptions(values);
  const auto path = values["config"].as<std::string>();
  if (path.empty()) return settings;
  std::map<std::string, OptionMap> struts = takeGroups(settings, kStruts);
  bool is_model = toNominal(settings);
  for (auto& [name, own] : struts) {
    is_model = toNominal(own) || is_model;
    for (auto& [key, value] : own) settings[std::string(kStruts) + '/' + name + '/' + key] = value;
  }
  if (is_model) settings.insert({"model_file", path});
  return settings;
}

BagOptions readLiveOptions(const po::variables_map& values) {
  BagOptions options;
  options.vehicle = readVehicle(values);
  AskedVehicle& vehicle = options.vehicle;
  if (vehicle.isStrutAlone()) {
    PipelineOptions strut = PipelineOptions::fromValues(givenSettings(values));
    strut.monitor.tyre = vehicle.layout.road_imu.has_value();
    options.settings = VehicleOptions::ofOneStrut(strut);
  } else {
    options.settings = VehicleOptions::fromValues(vehicle.layout, givenSettings(values));
  }
  const PipelineOptions& common = options.settings.common;
  options.bags = bagsOf(values);
  options.bags.reads_ahead = threadsOf(values) > 1;
  if (!common.shell.target_frame.empty()) {
    options.bags.transforms = readStaticTransforms(options.bags.paths);
    requireFrame(common.shell.target_frame, *options.bags.transforms);
  }
  findSensors(options.bags, common.shell, vehicle.layout);
  options.bags.temperature_topics = options.settings.temperatureTopics();
  if (vehicle.isStrutAlone())
    for (std::size_t i = 0; i < options.bags.topics.size(); ++i)
      options.bags.topics[i].named_by = std::string("--") + kTopicOptions[i];
  options.period_measured = !common.monitor.sample_period;
  if (!options.period_measured) requireFittingPeriod(options.bags, options.period());
  return options;
}

void addEffectsFile(po::options_description& description) {
  description.add_options()(kEffectsFile, po::value<std::string>()->default_value(""),
                            "YAML file with laws of your own, beside the catalogue");
}

void addModelOptions(po::options_description& description) {
  addEffectsFile(description);
  description.add_options()(kModel, po::value<std::string>(), "YAML file with the model, as diagnose -o writes it");
}

}  // namespace suspension_health_monitor
