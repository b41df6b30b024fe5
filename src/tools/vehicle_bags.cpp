#include "vehicle_bags.h"

#include <optional>
#include <stdexcept>
#include <string>

#include "../ros/conversions.h"
#include "../ros/vehicle_sensors.h"
#include "errors.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kMessagesForPeriod = 20000;  // of one IMU: the mean of n spacings has 1/n of a stamp's jitter
constexpr std::size_t kFewestSpacings = 10;

void takeTopics(const VehicleStreams& streams, ImuBags& bags) {
  bags.topics.clear();
  bags.named_by.clear();
  for (const VehicleStreams::Imu& imu : streams.imus) {
    bags.topics.push_back(imu.topic);
    bags.named_by.push_back(imu.setting);
  }
}

/// Looks up the positions of struts that have a frame.
void place(VehicleLayout& layout, ImuBags bags, const PipelineOptions& options) {
  if (!layout.hasFrames() || !layout.body_imu) return;
  bags.transforms = readStaticTransforms(bags.paths);
  bags.topics = {*layout.body_imu};
  bags.named_by = {"body_imu"};
  std::optional<sensor_msgs::Imu> first;
  readTopics(bags, [&](std::size_t, const sensor_msgs::Imu& imu, Stamp) {
    first = imu;
    return false;
  });
  if (!first) throw TooLittleError("the bags hold no message of body_imu, " + *layout.body_imu);
  placeFrames(layout, *first, options.shell, *bags.transforms);
}

double measurePeriod(const ImuBags& bags) {
  PeriodMeasurement measurement(kFewestSpacings, std::vector<bool>(bags.topics.size(), true));
  std::size_t count = 0;
  readTopics(bags, [&](std::size_t topic, const sensor_msgs::Imu& imu, Stamp) {
    measurement.add(topic, toStamp(imu.header.stamp));
    return ++count < kMessagesForPeriod * bags.topics.size();
  });
  const std::optional<double> period = measurement.period();
  if (!period)
    throw TooLittleError("the sample period cannot be measured: fewer than " + std::to_string(kFewestSpacings) +
                         " increasing stamps on one of the topics (of " + std::to_string(count) + " messages)");
  return *period;
}

VehicleBag readBag(const ImuBags& bag, const PipelineOptions& options, const VehicleStreams& streams) {
  const double period = *options.monitor.sample_period;
  VehicleBag read;
  read.struts.resize(streams.channels.struts.size());
  VehicleSensors sensors(streams, options.shell, bag.transforms.get());
  VehicleGrid grid(period, streams, MonitorSettings(options.monitor).grid(period), [&](const VehicleSample& sample) {
    for (std::size_t i = 0; i < read.struts.size(); ++i) read.struts[i].samples.push_back(sample.ofStrut(i));
  });
  readTopics(bag, [&](std::size_t imu, const sensor_msgs::Imu& message, Stamp) {
    grid.push(imu, toStamp(message.header.stamp), sensors.read(imu, message));
    return true;
  });
  read.noise = grid.noise();
  read.alignment = grid.streams().describeAlignment();
  for (std::size_t i = 0; i < streams.imus.size(); ++i) {
    RejectCounts rejected = sensors.rejected(i);
    rejected += grid.rejected(i);
    read.imus.push_back({streams.imus[i].topic, rejected, grid.missed(i)});
  }
  return read;
}

}  // namespace

std::vector<VehicleBag> readVehicleDrives(ImuBags bags, PipelineOptions& options, VehicleLayout layout) {
  if (!layout.known_forces.empty())
    throw std::invalid_argument("known_forces/" + layout.known_forces.front().name +
                                ": forces are not read from bags, must be left out");
  place(layout, bags, options);
  const VehicleStreams streams(layout);
  takeTopics(streams, bags);
  if (!options.monitor.sample_period) options.monitor.sample_period = measurePeriod(bags);
  std::vector<VehicleBag> drives;
  for (const std::string& path : bags.paths) {
    ImuBags bag = bags;
    bag.paths = {path};
    drives.push_back(readBag(bag, options, streams));
  }
  return drives;
}

}  // namespace suspension_health_monitor
