#include "imu_pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conversions.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kSpacingsForPeriod = 50;
constexpr std::size_t kMostEarly = 2 * UniformGrid::kMostWaiting;

}  // namespace

ImuPipeline::ImuPipeline(const PipelineOptions& options, Sink sink, const tf2::BufferCore* transforms)
    : options_(options),
      mounts_(ImuMount::of(options.shell, transforms)),
      sink_(std::move(sink)),
      measurement_(kSpacingsForPeriod) {
  if (options.monitor.sample_period) start(*options.monitor.sample_period);
}

void ImuPipeline::start(double period) {
  options_.monitor.sample_period = period;
  monitor_.emplace(options_.monitor);
  grid_.emplace(period, options_.grid(period));
  if (options_.shell.tyre) tyre_.emplace(options_.monitor);
  if (!effects_.empty()) monitor_->setEffects(effects_);
  if (baseline_) monitor_->setBaseline(*baseline_);
  if (kept_span_) keepSamples(*kept_span_);
}

void ImuPipeline::setBaseline(const Baseline& baseline) {
  if (monitor_)
    monitor_->setBaseline(baseline);
  else
    baseline_ = baseline;
}

void ImuPipeline::setEffects(const std::vector<ActiveEffect>& effects) {
  if (monitor_)
    monitor_->setEffects(effects);
  else
    effects_ = effects;
}

void ImuPipeline::reconfigure(MonitorOptions options) {
  options.sample_period = options_.monitor.sample_period;
  if (monitor_) monitor_->reconfigure(options);
  options_.monitor = options;
}

void ImuPipeline::keepSamples(double span) {
  kept_span_ = span;
  if (!monitor_) return;
  const double wanted = std::ceil(span / monitor_->period()) + 1.0;
  const auto capacity = static_cast<std::size_t>(std::min(wanted, static_cast<double>(kMostKept)));
  recent_.emplace(capacity);
  recent_body_.emplace(capacity);
}

DriveSamples ImuPipeline::newestSamples(double span) const {
  return recent_ ? recent_->newest(fromSeconds(span)) : DriveSamples{};
}

std::vector<BodyMotion> ImuPipeline::newestBodyMotion(double span) const {
  return recent_body_ ? recent_body_->newest(fromSeconds(span)) : std::vector<BodyMotion>{};
}

void ImuPipeline::push(Side side, const sensor_msgs::Imu& imu) {
  const auto acceleration = mounts_[static_cast<std::size_t>(side)].acceleration(imu);
  if (const RejectReason* reason = std::get_if<RejectReason>(&acceleration)) {
    rejected_.add(*reason);
    return;
  }
  const Reading reading{side, toStamp(imu.header.stamp), std::get<double>(acceleration)};
  if (recent_body_ && side == Side::kSprung)
    if (const BodyMotion motion = mounts_[0].across(imu); recent_body_->isNewer(motion)) recent_body_->push(motion);
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
  for (auto sample = grid_->push(reading.side, reading.stamp, reading.acceleration); sample; sample = grid_->next()) {
    if (recent_) keep(*sample);
    if (tyre_) tyre_->add(*sample, grid_->roadAcceleration());
    if (const MonitorReport* report = monitor_->addSample(*sample)) sink_(*report);
  }
}

void ImuPipeline::keep(const CornerSample& sample) {
  if (!isUsable(sample.sprung_acceleration) || !isUsable(sample.unsprung_acceleration)) return;
  if (!recent_->isNewer(sample)) recent_body_->clear();  // the clock went back
  recent_->push(sample);
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
