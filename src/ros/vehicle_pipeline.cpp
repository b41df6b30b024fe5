#include "vehicle_pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conversions.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kSpacingsForPeriod = 50;
constexpr std::uint64_t kInstantsForNoise = 512;
constexpr double kMostKept = 4000000.0;  // samples of one strut, of 24 bytes each

}  // namespace

VehiclePipeline::VehiclePipeline(const VehicleOptions& options, const VehicleStreams& streams,
                                 const tf2::BufferCore* transforms, Sinks sinks)
    : options_(options),
      streams_(streams),
      sinks_(std::move(sinks)),
      sensors_(streams, options.common.shell, transforms),
      measurement_(kSpacingsForPeriod, std::vector<bool>(streams.imus.size(), true)),
      rejected_(streams.imus.size()) {
  if (options_.common.monitor.sample_period) start(*options_.common.monitor.sample_period);
}

void VehiclePipeline::start(double period) {
  std::vector<MonitorSettings> settings;
  for (const PipelineOptions& strut : options_.struts) {
    settings.emplace_back(strut.monitor);
    settings.back().sample_period = period;
  }
  period_ = period;
  grid_.emplace(period, streams_, MonitorSettings(options_.common.monitor).grid(period),
                [this](const VehicleSample& sample) { take(sample); });
  const double kept = std::ceil(options_.common.shell.diagnose_window / period) + 1.0;
  recent_.assign(settings.size(), RecentSamples(static_cast<std::size_t>(std::min(kept, kMostKept))));
  monitor_.emplace(settings, sinks_.report);
  sinks_.begin(*monitor_);
}

void VehiclePipeline::push(std::size_t imu, const sensor_msgs::Imu& message) {
  const std::vector<double>& values = sensors_.read(imu, message);
  if (values.empty()) return;
  const Stamp stamp = toStamp(message.header.stamp);
  if (monitor_)
    grid_->push(imu, stamp, values);
  else
    measurePeriod({imu, stamp, values});
}

void VehiclePipeline::measurePeriod(Reading reading) {
  RejectCounts& rejected = rejected_[reading.imu];
  const bool goes_back = measurement_.goesBack(reading.imu, reading.stamp);
  if (!measurement_.add(reading.imu, reading.stamp))
    return rejected.add(reading.stamp == Stamp::zero() ? RejectReason::kZeroStamp : RejectReason::kRepeatedStamp);
  if (goes_back) return rejected.add(RejectReason::kTimeWentBack);
  if (early_.size() == streams_.imus.size() * StreamGrid::kMostWaiting) {  // one IMU is silent
    for (const Reading& each : early_) rejected_[each.imu].add(RejectReason::kMissingPartner);
    early_.clear();
    measurement_ = PeriodMeasurement(kSpacingsForPeriod, std::vector<bool>(streams_.imus.size(), true));
  }
  early_.push_back(std::move(reading));
  const std::optional<double> period = measurement_.period();
  if (!period) return;
  start(*period);
  for (const Reading& each : std::exchange(early_, {})) grid_->push(each.imu, each.stamp, each.values);
}

void VehiclePipeline::take(const VehicleSample& sample) {
  newest_ = sample.stamp;
  if (grid_->numInstants() >= kInstantsForNoise && !knows_noise_) {
    monitor_->setNoise(grid_->noise());
    knows_noise_ = true;
  }
  for (std::size_t i = 0; i < recent_.size(); ++i) recent_[i].push(sample.ofStrut(i));
  monitor_->addSample(sample);
}

StrutDrives VehiclePipeline::newestSamples(double span) const {
  StrutDrives drives(options_.struts.size());
  for (std::size_t i = 0; i < recent_.size(); ++i) drives[i].samples = recent_[i].newest(fromSeconds(span));
  return drives;
}

RejectCounts VehiclePipeline::rejected(std::size_t imu) const {
  RejectCounts all = sensors_.rejected(imu);
  all += rejected_[imu];
  if (grid_) all += grid_->rejected(imu);
  return all;
}

}  // namespace suspension_health_monitor
