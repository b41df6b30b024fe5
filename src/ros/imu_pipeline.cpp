#include "imu_pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kSpacingsForPeriod = 50;
constexpr std::size_t kMostEarly = 2 * UniformGrid::kMostWaiting;

}  // namespace

ImuPipeline::ImuPipeline(const PipelineOptions& options, Sink sink, const tf2::BufferCore* transforms)
    : options_(options), sensors_(options.shell, transforms), sink_(std::move(sink)), measurement_(kSpacingsForPeriod) {
  if (options.monitor.sample_period) start(*options.monitor.sample_period);
}

void ImuPipeline::start(double period) {
  options_.monitor.sample_period = period;
  monitor_.emplace(options_.monitor);
  sensors_.start(options_, period);
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
  if (tyre_) tyre_->reconfigure(options);
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

std::vector<CornerSample> ImuPipeline::newestSamples(double span) const {
  return recent_ ? recent_->newest(fromSeconds(span)) : std::vector<CornerSample>{};
}

std::vector<BodyMotion> ImuPipeline::newestBodyMotion(double span) const {
  return recent_body_ ? recent_body_->newest(fromSeconds(span)) : std::vector<BodyMotion>{};
}

void ImuPipeline::push(Side side, const sensor_msgs::Imu& imu) {
  const std::optional<StrutSensors::Reading> reading = sensors_.read(side, imu);
  if (!reading) return;
  if (recent_body_ && side == Side::kSprung)
    if (const BodyMotion motion = sensors_.across(imu); recent_body_->isNewer(motion)) recent_body_->push(motion);
  if (monitor_) {
    push(*reading);
    return;
  }
  const bool goes_back = measurement_.goesBack(side, reading->stamp);
  if (!measurement_.add(side, reading->stamp)) {
    rejected_.add(reading->stamp == Stamp::zero() ? RejectReason::kZeroStamp : RejectReason::kRepeatedStamp);
    return;
  }
  if (goes_back) {
    rejected_.add(RejectReason::kTimeWentBack);
    return;
  }
  if (early_.size() == kMostEarly) {  // one IMU is silent
    for (std::size_t i = 0; i < early_.size(); ++i) rejected_.add(RejectReason::kMissingPartner);
    early_.clear();
    measurement_ = PeriodMeasurement(kSpacingsForPeriod);
  }
  early_.push_back(*reading);
  if (const std::optional<double> period = measurement_.period()) {
    start(*period);
    for (const StrutSensors::Reading& waiting : std::exchange(early_, {})) push(waiting);
  }
}

void ImuPipeline::push(const StrutSensors::Reading& reading) {
  for (auto sample = sensors_.push(reading); sample; sample = sensors_.next()) {
    if (recent_) keep(*sample);
    if (tyre_) {
      tyre_->setPeriodFits(monitor_->input().period_fits);
      tyre_->add(*sample, grid()->roadAcceleration());
    }
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
  all += sensors_.rejected();
  if (monitor_) all += monitor_->rejected();
  return all;
}

}  // namespace suspension_health_monitor
