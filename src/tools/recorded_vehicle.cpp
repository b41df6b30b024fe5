#include "recorded_vehicle.h"

#include <cstdio>
#include <stdexcept>
#include <utility>

#include "../ros/conversions.h"
#include "../ros/vehicle_file.h"
#include "../ros/vehicle_sensors.h"
#include "bag_options.h"
#include "command.h"
#include "suspension_health_monitor/internal/signal/alignment_judge.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

/// Looks up the positions of struts that have a frame.
void place(VehicleLayout& layout, ImuBags bags, const PipelineOptions& options) {
  if (!layout.hasFrames() || !layout.body_imu) return;
  bags.transforms = readStaticTransforms(bags.paths);
  bags.topics = {*layout.body_imu};
  bags.named_by = {"body_imu"};
  std::optional<sensor_msgs::Imu> first;
  const auto take = [&](std::size_t, const sensor_msgs::Imu& imu, Stamp) {
    first = imu;
    return false;
  };
  readTopics(bags, {take, {}});
  if (!first) throw TooLittleError("the bags hold no message of body_imu, " + *layout.body_imu);
  placeFrames(layout, *first, options.shell, *bags.transforms);
}

VehicleBag readBag(const ImuBags& bag, const PipelineOptions& options, const VehicleLayout& layout,
                   const VehicleStreams& streams) {
  const double period = *options.monitor.sample_period;
  VehicleBag read;
  read.drive.struts.resize(layout.struts.size());
  for (const VehicleLayout::KnownForce& force : layout.known_forces) read.drive.forces.push_back({force.name, {}});
  VehicleSensors sensors(streams, options.shell, bag.transforms.get());
  VehicleGrid grid(period, streams, MonitorSettings(options.monitor).grid(period),
                   [&](const VehicleSample& sample) { append(sample, read.drive); });
  const auto take = [&](std::size_t sensor, const auto& message, Stamp) {
    if (grid.push(sensor, toStamp(message.header.stamp), sensors.read(sensor, message)))
      dropNewest(read.drive, AlignmentJudge::kOutcomes);
    return true;
  };
  readTopics(bag, {take, take});
  grid.finish();
  grid.describe(read.drive);
  read.drive.places = grid.tops().places();
  read.body_level = grid.bodyLevel();
  read.alignment = grid.streams().describeAlignment();
  for (std::size_t i = 0; i < streams.sensors.size(); ++i) {
    RejectCounts rejected = sensors.rejected(i);
    rejected += grid.rejected(i);
    read.sensors.push_back({streams.sensors[i].topic, rejected, grid.missed(i)});
  }
  return read;
}

}  // namespace

bool isOfVehicle(const po::variables_map& values) {
  if (values.count(kStrut) != 0 && values.count(kVehicle) == 0)
    throw std::invalid_argument("--strut " + values[kStrut].as<std::string>() + " without --vehicle, which it is of");
  return values.count(kVehicle) != 0;
}

AskedVehicle readVehicle(const po::variables_map& values) {
  for (const std::string option : kTopicOptions)
    if (const std::string name = option.substr(2); values.count(name) != 0 && !values[name].defaulted())
      throw std::invalid_argument(option + " beside --vehicle, must be left out");
  AskedVehicle vehicle;
  vehicle.file = values[kVehicle].as<std::string>();
  vehicle.layout = readVehicleFile(vehicle.file);
  for (const VehicleLayout::Strut& strut : vehicle.layout.struts) vehicle.names.push_back(strut.name);
  for (std::size_t i = 0; i < vehicle.names.size(); ++i)
    if (values.count(kStrut) == 0 || values[kStrut].as<std::string>() == vehicle.names[i]) vehicle.asked.push_back(i);
  if (vehicle.asked.empty())
    throw std::invalid_argument("--strut " + values[kStrut].as<std::string>() + ", must be one of " +
                                join(vehicle.names));
  if (values.count(kStrut) != 0) vehicle.only = vehicle.asked.front();
  return vehicle;
}

std::vector<std::string> topicsOf(const VehicleStreams& streams) {
  std::vector<std::string> topics;
  for (const VehicleStreams::Sensor& sensor : streams.sensors) topics.push_back(sensor.topic);
  return topics;
}

VehicleStreams streamsOf(ImuBags& bags, const PipelineOptions& options, VehicleLayout& layout) {
  place(layout, bags, options);
  VehicleStreams streams(layout);
  bags.topics = streams.topicsOfImus();
  bags.wrench_topics = streams.topicsOfForces();
  bags.named_by.clear();
  for (const VehicleStreams::Sensor& sensor : streams.sensors) bags.named_by.push_back(sensor.setting);
  return streams;
}

std::vector<VehicleBag> readVehicleDrives(ImuBags bags, PipelineOptions& options, VehicleLayout& layout,
                                          TopicGaps& gaps) {
  const VehicleStreams streams = streamsOf(bags, options, layout);
  if (options.monitor.sample_period)
    requireFittingPeriod(bags, *options.monitor.sample_period);
  else
    options.monitor.sample_period = measurePeriod(bags);
  std::vector<VehicleBag> drives;
  for (const std::string& path : bags.paths) {
    ImuBags bag = bags;
    bag.paths = {path};
    bag.gaps = &gaps;
    drives.push_back(readBag(bag, options, layout, streams));
  }
  layout.turn(drives.front().body_level.mount());
  return drives;
}

std::vector<VehicleDrive> readDrives(const po::variables_map& values, AskedVehicle& vehicle, PipelineOptions& options,
                                     TopicGaps& gaps) {
  std::vector<VehicleBag> read = readVehicleDrives(readBags(values, options.shell), options, vehicle.layout, gaps);
  std::printf("sample period %.6g s\n", *options.monitor.sample_period);
  std::vector<VehicleDrive> drives;
  for (VehicleBag& bag : read) {
    const StrutDrives& struts = bag.drive.struts;
    printReadings(struts.front().samples.size(), struts.size(), bag.alignment, bag.body_level);
    for (const VehicleBag::Sensor& sensor : bag.sensors) printRejected(sensor.topic, sensor.rejected);
    drives.push_back(std::move(bag.drive));
  }
  gaps.print();
  return drives;
}

void requireCoupling(const VehicleCoupling& coupling) {
  if (!coupling) throw TooLittleError("the drives " + coupling.reason);
}

void printReadings(std::size_t num_samples, std::size_t num_struts, const std::string& alignment,
                   const BodyLevel& level) {
  std::printf("%zu samples of %zu struts, readings %s\n", num_samples, num_struts, alignment.c_str());
  const std::string leans = describe(level);
  if (!leans.empty()) std::printf("%s\n", leans.c_str());
}

void printRejected(const std::string& topic, const RejectCounts& rejected) {
  if (rejected.total() > 0) std::printf("%s%s\n", topic.c_str(), describeRejected(rejected).c_str());
}

std::vector<IdentifyOptions> identifyOptionsOf(const VehicleOptions& settings) {
  std::vector<IdentifyOptions> options;
  for (const PipelineOptions& strut : settings.struts) {
    IdentifyOptions& its = options.emplace_back();
    its.sample_period = settings.common.monitor.sample_period;
    its.horizon_samples = givenHorizon(strut, *its.sample_period);
    its.memory = strut.monitor.memory;
  }
  return options;
}

CompareOptions compareOptionsOf(const PipelineOptions& strut, double sample_period,
                                const std::optional<StrutModel>& model) {
  CompareOptions options;
  options.sample_period = sample_period;
  options.horizon_samples = givenHorizon(strut, sample_period);
  options.model = model;
  options.fit = !model;
  return options;
}

std::vector<DiagnoseOptions> diagnoseOptionsOf(const VehicleOptions& settings, DiagnoseOptions& options) {
  options.sample_period = settings.common.monitor.sample_period;
  std::vector<DiagnoseOptions> by_strut(settings.struts.size(), options);
  for (std::size_t i = 0; i < by_strut.size(); ++i)
    by_strut[i].horizon_samples = givenHorizon(settings.struts[i], *options.sample_period);
  return by_strut;
}

std::optional<int> givenHorizon(const PipelineOptions& strut, double sample_period) {
  if (!strut.monitor.integration_horizon) return std::nullopt;
  return MonitorSettings(strut.monitor).horizonSamples(sample_period);
}

}  // namespace suspension_health_monitor
