#include "vehicle_bags.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "../ros/conversions.h"
#include "../ros/vehicle_sensors.h"
#include "errors.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/signal/stream_grid.h"

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
  const bool has_frames = std::any_of(layout.struts.begin(), layout.struts.end(),
                                      [](const VehicleLayout::Strut& strut) { return strut.frame.has_value(); });
  if (!has_frames || !layout.body_imu) return;
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

void append(const VehicleSample& sample, StrutDrives& struts) {
  for (std::size_t i = 0; i < struts.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    struts[i].samples.push_back({sample.stamp, sample.sprung[row], sample.unsprung[row]});
  }
}

/// @return what became of the messages of every IMU.
std::vector<VehicleBag::Imu> account(const VehicleStreams& streams, const VehicleSensors& sensors,
                                     const StreamGrid& grid) {
  std::vector<VehicleBag::Imu> imus;
  for (std::size_t i = 0; i < streams.imus.size(); ++i) {
    const VehicleStreams::Imu& imu = streams.imus[i];
    VehicleBag::Imu& its = imus.emplace_back(VehicleBag::Imu{imu.topic, sensors.rejected(i), 0});
    const std::size_t sensor = streams.options[imu.stream].sensor;
    for (std::size_t stream = imu.stream; stream < streams.options.size(); ++stream) {
      if (streams.options[stream].sensor != sensor) break;
      its.rejected += grid.rejected(stream);
      its.missed = std::max(its.missed, grid.missed(stream));
    }
  }
  return imus;
}

VehicleBag readBag(const ImuBags& bag, const PipelineOptions& options, const VehicleStreams& streams) {
  VehicleSensors sensors(streams, options.shell, bag.transforms.get());
  const double period = *options.monitor.sample_period;
  StrutTops tops(fromSeconds(period), streams.channels);
  const GridOptions alignment = MonitorSettings(options.monitor).grid(period);
  // Before an instant is of use the tops' filter fills, too.
  StreamGrid grid(period, streams.options, alignment.alignment, alignment.fill_samples + 2 * tops.delay());
  VehicleBag read;
  read.struts.resize(streams.channels.struts.size());
  readTopics(bag, [&](std::size_t imu, const sensor_msgs::Imu& message, Stamp) {
    std::size_t stream = streams.imus[imu].stream;
    for (const double value : sensors.read(imu, message))
      for (auto instant = grid.push(stream++, toStamp(message.header.stamp), value); instant != nullptr;
           instant = grid.next())
        if (const VehicleSample* sample = tops.push(*instant)) append(*sample, read.struts);
    return true;
  });
  read.alignment = grid.describeAlignment();
  read.imus = account(streams, sensors, grid);
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
