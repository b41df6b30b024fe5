#include "imu_pipeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conversions.h"
#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

ImuPipeline::ImuPipeline(const PipelineOptions& options, Sink sink, const tf2::BufferCore* transforms)
    : kept_span_(options.shell.diagnose_window),
      sensors_(options.shell, transforms),
      strut_(options.monitor, {std::move(sink), [this](const CornerSample& sample) { keep(sample); }}) {}

void ImuPipeline::push(Side side, const sensor_msgs::Imu& imu) {
  const std::optional<double> acceleration = sensors_.read(side, imu);
  if (!acceleration) return;
  if (recent_body_ && side == Side::kSprung)
    if (const BodyMotion motion = sensors_.across(imu); recent_body_->isNewer(motion)) recent_body_->push(motion);
  strut_.push(side, toStamp(imu.header.stamp), *acceleration);
}

void ImuPipeline::keep(const CornerSample& sample) {
  if (!isUsable(sample.sprung_acceleration) || !isUsable(sample.unsprung_acceleration)) return;
  if (!recent_) {
    const double wanted = std::ceil(kept_span_ / monitor()->period()) + 1.0;
    const auto capacity = static_cast<std::size_t>(std::min(wanted, static_cast<double>(kMostKept)));
    recent_.emplace(capacity);
    recent_body_.emplace(capacity);
  }
  if (!recent_->isNewer(sample)) recent_body_->clear();  // the clock went back
  recent_->push(sample);
}

std::vector<CornerSample> ImuPipeline::newestSamples(double span) const {
  return recent_ ? recent_->newest(fromSeconds(span)) : std::vector<CornerSample>{};
}

std::vector<BodyMotion> ImuPipeline::newestBodyMotion(double span) const {
  return recent_body_ ? recent_body_->newest(fromSeconds(span)) : std::vector<BodyMotion>{};
}

RejectCounts ImuPipeline::rejected() const {
  RejectCounts all = sensors_.rejected();
  all += strut_.rejected();
  return all;
}

}  // namespace suspension_health_monitor
