#include "vehicle_pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conversions.h"

namespace suspension_health_monitor {
namespace {

constexpr double kMostKept = 4000000.0;  // samples of one strut, of 40 bytes each

}  // namespace

VehiclePipeline::VehiclePipeline(const VehicleOptions& options, const VehicleStreams& streams,
                                 const tf2::BufferCore* transforms, Sinks sinks)
    : options_(options),
      streams_(streams),
      sinks_(std::move(sinks)),
      sensors_(streams, options.common.shell, transforms),
      early_(std::vector<bool>(streams.sensors.size(), true), StreamGrid::kMostWaiting) {
  if (options_.common.monitor.sample_period) start(*options_.common.monitor.sample_period);
}

void VehiclePipeline::start(double period) {
  std::vector<MonitorSettings> settings;
  for (const PipelineOptions& strut : options_.struts) {
    settings.emplace_back(strut.monitor);
    settings.back().sample_period = period;
  }
  period_ = period;
  grid_.emplace(
      period, streams_, MonitorSettings(options_.common.monitor).grid(period),
      [this](const VehicleSample& sample) { take(sample); },
      [this](const VehicleReading& reading) { monitor_->addReading(grid_->tops(), reading); });
  const double kept = std::ceil(options_.common.shell.diagnose_window / period) + 1.0;
  const auto capacity = static_cast<std::size_t>(std::min(kept, kMostKept));
  recent_.assign(settings.size(), Recent<StrutSample>(capacity));
  const std::size_t forces = streams_.channels.known_forces.size();
  if (forces > 0) recent_forces_.emplace(capacity);
  monitor_.emplace(settings, sinks_.report, static_cast<int>(forces));
  sinks_.begin(*monitor_);
}

void VehiclePipeline::push(std::size_t sensor, const sensor_msgs::Imu& message) {
  push(sensor, toStamp(message.header.stamp), sensors_.read(sensor, message));
}

void VehiclePipeline::push(std::size_t sensor, const geometry_msgs::WrenchStamped& message) {
  push(sensor, toStamp(message.header.stamp), sensors_.read(sensor, message));
}

void VehiclePipeline::push(std::size_t sensor, Stamp stamp, const std::vector<double>& values) {
  if (values.empty()) return;
  if (monitor_) return grid_->push(sensor, stamp, values);
  const std::optional<double> period = early_.add({sensor, stamp, values});
  if (!period) return;
  start(*period);
  while (const auto reading = early_.next()) grid_->push(reading->stream, reading->stamp, reading->value);
}

void VehiclePipeline::finish() {
  if (grid_) grid_->finish();
}

void VehiclePipeline::take(const VehicleSample& sample) {
  newest_ = sample.stamp;
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    StrutSample strut{sample.ofStrut(i), {}};
    if (sample.unfiltered.size() > 0) strut.unfiltered = sample.unfiltered[static_cast<Eigen::Index>(i)];
    recent_[i].push(strut);
  }
  if (recent_forces_) recent_forces_->push({sample.stamp, sample.forces});
  monitor_->addGridSample(sample);
}

VehicleDrive VehiclePipeline::newestSamples(double span) const {
  VehicleDrive drive{StrutDrives(options_.struts.size())};
  for (std::size_t i = 0; i < recent_.size(); ++i)
    for (const StrutSample& sample : recent_[i].newest(fromSeconds(span))) {
      drive.struts[i].samples.push_back(sample);
      if (sample.unfiltered) drive.struts[i].low_pass.unfiltered.push_back(*sample.unfiltered);
    }
  if (!recent_forces_) return drive;
  for (const std::string& name : options_.forceNames()) drive.forces.push_back({name, {}});
  for (const Forces& forces : recent_forces_->newest(fromSeconds(span)))
    for (std::size_t k = 0; k < drive.forces.size(); ++k)
      drive.forces[k].values.push_back(forces.values[static_cast<Eigen::Index>(k)]);
  return drive;
}

RejectCounts VehiclePipeline::rejected(std::size_t sensor) const {
  RejectCounts all = sensors_.rejected(sensor);
  all += early_.rejected(sensor);
  if (grid_) all += grid_->rejected(sensor);
  return all;
}

}  // namespace suspension_health_monitor
