#include "suspension_health_monitor/discrepancy/drive_record.h"

#include <algorithm>

#include "suspension_health_monitor/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr int kStuckRepeats = 4;  // a value that is read so many times again is a stuck one
constexpr std::size_t kShortestSegment = 32;

}  // namespace

DriveRecord::DriveRecord(double period, int steps) : period_(period), steps_(steps) {}

void DriveRecord::push(const CornerSample& sample) {
  const bool first = stretches_.empty();
  if (first) first_ = sample.stamp;
  const Continuity follows = first ? Continuity::kGap : continuity(sample.stamp - last_.stamp, fromSeconds(period_));
  if (follows == Continuity::kTooSoon) return;
  if (follows == Continuity::kContinues) {
    repeats_[0] = sample.sprung_acceleration == last_.sprung_acceleration ? repeats_[0] + 1 : 0;
    repeats_[1] = sample.unsprung_acceleration == last_.unsprung_acceleration ? repeats_[1] + 1 : 0;
  } else {
    stretches_.emplace_back();
    repeats_ = {};
  }
  last_ = sample;
  if (std::max(repeats_[0], repeats_[1]) >= kStuckRepeats) {
    endBeforeStuckReadings();
    return;
  }
  Stretch& stretch = stretches_.back();
  if (stretch.wheel.empty()) stretch.start = toSeconds(sample.stamp - first_);
  stretch.sprung.push_back(sample.sprung_acceleration);
  stretch.wheel.push_back(sample.unsprung_acceleration);
}

void DriveRecord::endBeforeStuckReadings() {
  Stretch& stretch = stretches_.back();
  if (stretch.wheel.empty()) return;  // ended already
  const std::size_t kept = stretch.wheel.size() - std::min<std::size_t>(stretch.wheel.size(), kStuckRepeats);
  stretch.sprung.resize(kept);
  stretch.wheel.resize(kept);
  stretches_.emplace_back();
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
    segment.unsprung.push_back(wheel[k]);
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
