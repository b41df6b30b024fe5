#include "suspension_health_monitor/internal/signal/resampled_grid.h"

#include <algorithm>

namespace suspension_health_monitor {

using Coverage = StreamResampler::Coverage;

ResampledGrid::ResampledGrid(Stamp period, bool has_road)
    : period_(period),
      has_road_(has_road),
      streams_{StreamResampler(period), StreamResampler(period), StreamResampler(period)} {}

std::optional<CornerSample> ResampledGrid::next(WaitingReadings& waiting) {
  while (begin(waiting)) {
    const Stamp t = *next_;
    StreamResampler& sprung = stream(Side::kSprung);
    StreamResampler& unsprung = stream(Side::kUnsprung);
    const Coverage body = sprung.advance(t, waiting[Side::kSprung]);
    const Coverage wheel = unsprung.advance(t, waiting[Side::kUnsprung]);
    if (body == Coverage::kInterrupted || wheel == Coverage::kInterrupted) {
      next_.reset();
      continue;
    }
    if (body == Coverage::kComes || wheel == Coverage::kComes || !findRoad(t, waiting)) return std::nullopt;
    next_ = t + period_;
    const StreamResampler::Value z = sprung.at(t), w = unsprung.at(t);
    if (z.still == w.still) return CornerSample{t, z.acceleration, w.acceleration};
    rejected_.add(RejectReason::kStuck);
  }
  return std::nullopt;
}

// @return false: a stream has no readings.
bool ResampledGrid::begin(WaitingReadings& waiting) {
  if (next_) return true;
  const std::optional<Stamp> body = stream(Side::kSprung).earliest(waiting[Side::kSprung]);
  const std::optional<Stamp> wheel = stream(Side::kUnsprung).earliest(waiting[Side::kUnsprung]);
  if (!body || !wheel) return false;
  const Stamp first = std::max(*body, *wheel);
  if (!origin_) origin_ = first;
  next_ = *origin_ + (first - *origin_ + period_ - Stamp(1)) / period_ * period_;
  return true;
}

// @return false: the road's readings of this instant may still come.
bool ResampledGrid::findRoad(Stamp t, WaitingReadings& waiting) {
  road_acceleration_.reset();
  if (!has_road_) return true;
  if (!waiting[Side::kRoad].empty()) road_is_silent_ = false;
  const Coverage coverage = stream(Side::kRoad).advance(t, waiting[Side::kRoad]);
  if (coverage == Coverage::kCovered) road_acceleration_ = stream(Side::kRoad).at(t).acceleration;
  if (coverage != Coverage::kComes) return true;
  road_is_silent_ = road_is_silent_ || waiting[Side::kSprung].size() > kMostRoadLag;
  return road_is_silent_;
}

void ResampledGrid::startNewSeries() {
  for (StreamResampler& each : streams_) each.clear();
  origin_.reset();
  next_.reset();
}

std::uint64_t ResampledGrid::bridged() const {
  std::uint64_t sum = 0;
  for (const StreamResampler& each : streams_) sum += each.bridged();
  return sum;
}

}  // namespace suspension_health_monitor
