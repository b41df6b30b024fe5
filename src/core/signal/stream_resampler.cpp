#include "suspension_health_monitor/signal/stream_resampler.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kFewest = 3;  // readings in the window

}  // namespace

StreamResampler::StreamResampler(Stamp period)
    : reach_(kHalfWidth * period), per_period_(1.0 / static_cast<double>(period.count())), readings_(kCapacity) {}

void StreamResampler::dropOldest() {
  gaps_ -= reading(0).after_gap ? 1 : 0;
  first_ = (first_ + 1) % kCapacity;
  --size_;
}

void StreamResampler::push(const Reading& reading) {
  gaps_ += reading.after_gap ? 1 : 0;
  readings_[(first_ + size_++) % kCapacity] = reading;
}

void StreamResampler::clear() { first_ = size_ = gaps_ = 0; }

std::optional<Stamp> StreamResampler::earliest() const {
  if (size_ == 0) return std::nullopt;
  return reading(0).stamp + reach_;
}

StreamResampler::Coverage StreamResampler::look(Stamp t) {
  while (size_ >= 2 && reading(1).stamp <= t - reach_) dropOldest();
  if (size_ == 0) return Coverage::kComes;
  if (reading(0).stamp > t - reach_) return Coverage::kInterrupted;
  const std::size_t before = gaps_ - (reading(0).after_gap ? 1 : 0);
  for (std::size_t i = 1; before > 0 && i < size_ && reading(i - 1).stamp < t + reach_; ++i) {
    if (!reading(i).after_gap) continue;
    while (i-- > 0) dropOldest();
    return Coverage::kInterrupted;
  }
  return newest()->stamp >= t + reach_ ? Coverage::kCovered : Coverage::kComes;
}

StreamResampler::Value StreamResampler::at(Stamp t) const {
  // The first reading lies at or before the window, one at its end or behind it.
  const double reference = reading(0).acceleration;  // a constant then passes without any rounding
  WindowSums sums;
  bool still = reading(0).still;
  std::size_t i = 1;
  for (; reading(i).stamp < t + reach_; ++i) {
    const Reading& it = reading(i);
    const double spacing = 0.5 * static_cast<double>((reading(i + 1).stamp - reading(i - 1).stamp).count());
    sums.add(static_cast<double>((it.stamp - t).count()) * per_period_, spacing * per_period_,
             it.acceleration - reference);
    if (it.stamp <= t) still = it.still;
  }
  if (i > kFewest) return {reference + sums.value(), still};
  // A stream so slow that the window tells nothing of its course.
  for (i = 0; reading(i + 1).stamp <= t; ++i) continue;
  const Reading& before = reading(i);
  const Reading& after = reading(i + 1);
  const double part =
      static_cast<double>((t - before.stamp).count()) / static_cast<double>((after.stamp - before.stamp).count());
  return {before.acceleration + part * (after.acceleration - before.acceleration), before.still};
}

}  // namespace suspension_health_monitor
