#include "vehicle_bags.h"

#include <optional>

#include "../ros/conversions.h"
#include "../ros/vehicle_sensors.h"
#include "command.h"
#include "survey.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

namespace suspension_health_monitor {
namespace {

void takeTopics(const VehicleStreams& streams, ImuBags& bags) {
  bags.topics = streams.topicsOfImus();
  bags.wrench_topics = streams.topicsOfForces();
  bags.named_by.clear();
  for (const VehicleStreams::Sensor& sensor : streams.sensors) bags.named_by.push_back(sensor.setting);
}

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
    grid.push(sensor, toStamp(message.header.stamp), sensors.read(sensor, message));
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

VehicleStreams streamsOf(ImuBags& bags, const PipelineOptions& options, VehicleLayout& layout) {
  place(layout, bags, options);
  VehicleStreams streams(layout);
  takeTopics(streams, bags);
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

}  // namespace suspension_health_monitor
