#include "suspension_health_monitor/discrepancy/drive_record.h"

#include <algorithm>

#include "suspension_health_monitor/signal/bandlimited_interpolator.h"
#include "suspension_health_monitor/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr int kStuckReadings = 4;          // equal ones in a row
constexpr std::size_t kShortestSegment = 32;

}  // namespace

DriveRecord::DriveRecord(double period, int steps) : period_(period), steps_(steps) {}

void DriveRecord::push(const CornerSample& sample) {
  const bool first = stretches_.empty();
  if (first) first_ = sample.stamp;
  const Continuity follows = first ? Continuity::kGap : continuity(sample.stamp - last_, fromSeconds(period_));
  if (follows == Continuity::kTooSoon) return;
  last_ = sample.stamp;
  const auto begin = [&] { stretches_.push_back({toSeconds(sample.stamp - first_), {}, {}}); };
  if (follows != Continuity::kContinues) {
    begin();
    repeats_ = {};
  }
  Stretch* stretch = &stretches_.back();
  if (!stretch->sprung.empty()) {
    repeats_[0] = sample.sprung_acceleration == stretch->sprung.back() ? repeats_[0] + 1 : 0;
    repeats_[1] = sample.unsprung_acceleration == stretch->wheel.back() ? repeats_[1] + 1 : 0;
    if (repeats_[0] >= kStuckReadings || repeats_[1] >= kStuckReadings) {
      const auto stuck = std::min<std::size_t>(stretch->sprung.size(), kStuckReadings);
      stretch->sprung.resize(stretch->sprung.size() - stuck);
      stretch->wheel.resize(stretch->wheel.size() - stuck);
      begin();
      stretch = &stretches_.back();
    }
  }
  stretch->sprung.push_back(sample.sprung_acceleration);
  stretch->wheel.push_back(sample.unsprung_acceleration);
}

void DriveRecord::finish() {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Stretch& stretch : stretches_) {
    for (const double wheel : stretch.wheel) sum += wheel;
    count += stretch.wheel.size();
  }
  mean_wheel_ = count > 0 ? sum / static_cast<double>(count) : 0.0;
  for (const Stretch& stretch : stretches_) addSegment(stretch);
  stretches_.clear();
}

void DriveRecord::addSegment(const Stretch& stretch) {
  constexpr std::size_t kEnd = BandlimitedInterpolator::kHalfWidth;
  if (stretch.wheel.size() < 2 * kEnd + kShortestSegment) return;
  std::vector<double> wheel = stretch.wheel;
  for (double& w : wheel) w -= mean_wheel_;
  std::vector<WheelInterpolator> interpolators;
  for (int step = 0; step < steps_; ++step)
    interpolators.emplace_back(static_cast<double>(step) / steps_, (step + 1.0) / steps_, period_);

  DriveSegment segment;
  segment.start = stretch.start + static_cast<double>(kEnd) * period_;
  const std::size_t last = wheel.size() - 1 - kEnd;
  for (std::size_t k = kEnd; k <= last; ++k) {
    segment.sprung.push_back(stretch.sprung[k] - mean_wheel_);
    if (k < last)
      for (const WheelInterpolator& interpolate : interpolators)
        segment.wheel.push_back(interpolate(&wheel[k + 1 - kEnd]));
  }
  segments_.push_back(std::move(segment));
}

std::size_t DriveRecord::numSamples() const {
  std::size_t count = 0;
  for (const DriveSegment& segment : segments_) count += segment.size();
  return count;
}

}  // namespace suspension_health_monitor
