#include "imu_pipeline.h"

#include <utility>

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kSpacingsForPeriod = 50;
constexpr std::size_t kMostEarly = 2 * UniformGrid::kMostWaiting;

}  // namespace

ImuPipeline::ImuPipeline(const PipelineOptions& options, Sink sink)
    : options_(options),
      axes_{StrutAxis(options.shell.sprung_axis), StrutAxis(options.shell.unsprung_axis)},
      sink_(std::move(sink)),
      measurement_(kSpacingsForPeriod) {
  if (options.monitor.sample_period) start(*options.monitor.sample_period);
}

void ImuPipeline::start(double period) {
  options_.monitor.sample_period = period;
  monitor_.emplace(options_.monitor);
  grid_.emplace(period);
}

void ImuPipeline::push(Side side, const sensor_msgs::Imu& imu) {
  const std::optional<double> acceleration = axes_[static_cast<std::size_t>(side)].acceleration(imu);
  if (!acceleration) {
    rejected_.add(RejectReason::kNotMeasured);
    return;
  }
  const Reading reading{side, toStamp(imu.header.stamp), *acceleration};
  if (monitor_) {
    push(reading);
    return;
  }
  if (!measurement_.add(side, reading.stamp)) {
    rejected_.add(reading.stamp == Stamp::zero() ? RejectReason::kZeroStamp : RejectReason::kRepeatedStamp);
    return;
  }
  if (early_.size() == kMostEarly) {  // one IMU is silent
    for (std::size_t i = 0; i < early_.size(); ++i) rejected_.add(RejectReason::kMissingPartner);
    early_.clear();
    measurement_ = PeriodMeasurement(kSpacingsForPeriod);
  }
  early_.push_back(reading);
  if (const std::optional<double> period = measurement_.period()) {
    start(*period);
    for (const Reading& waiting : std::exchange(early_, {})) push(waiting);
  }
}

void ImuPipeline::push(const Reading& reading) {
  const std::optional<CornerSample> sample = grid_->push(reading.side, reading.stamp, reading.acceleration);
  if (!sample) return;
  if (const MonitorReport* report = monitor_->addSample(*sample)) sink_(*report);
}

RejectCounts ImuPipeline::rejected() const {
  RejectCounts all = rejected_;
  if (monitor_) {
    all += grid_->rejected();
    all += monitor_->rejected();
  }
  return all;
}

}  // namespace suspension_health_monitor
