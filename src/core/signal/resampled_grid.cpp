#include "suspension_health_monitor/signal/resampled_grid.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

using Coverage = StreamResampler::Coverage;

ResampledGrid::ResampledGrid(Stamp period, bool has_road)
    : period_(period),
      has_road_(has_road),
      streams_{StreamResampler(period), StreamResampler(period), StreamResampler(period)} {}

void ResampledGrid::push(Side side, Stamp stamp, double acceleration, bool still, double own_period) {
  StreamResampler& target = stream(side);
  if (side == Side::kRoad) road_is_silent_ = false;
  bool after_gap = false;
  if (const StreamResampler::Reading* before = target.newest()) {
    const double spacing = toSeconds(stamp - before->stamp);
    after_gap = spacing > kLongestBridge * std::max(own_period, toSeconds(period_));
    if (!after_gap && own_period > 0.0 && spacing >= 1.5 * own_period)
      bridged_ += static_cast<std::uint64_t>(std::round(spacing / own_period)) - 1;
  }
  if (target.full()) {
    rejected_.add(RejectReason::kMissingPartner);
    target.dropOldest();
  }
  target.push({stamp, acceleration, still, after_gap});
}

std::optional<CornerSample> ResampledGrid::next() {
  while (begin()) {
    const Stamp t = *next_;
    StreamResampler& sprung = stream(Side::kSprung);
    StreamResampler& unsprung = stream(Side::kUnsprung);
    const Coverage body = sprung.look(t), wheel = unsprung.look(t);
    if (body == Coverage::kInterrupted || wheel == Coverage::kInterrupted) {
      next_.reset();
      continue;
    }
    if (body == Coverage::kComes || wheel == Coverage::kComes || !findRoad(t)) return std::nullopt;
    next_ = t + period_;
    const StreamResampler::Value z = sprung.at(t), w = unsprung.at(t);
    if (z.still == w.still) return CornerSample{t, z.acceleration, w.acceleration};
    rejected_.add(RejectReason::kStuck);
  }
  return std::nullopt;
}

// @return false: a stream has no readings.
bool ResampledGrid::begin() {
  if (next_) return true;
  const std::optional<Stamp> body = stream(Side::kSprung).earliest(), wheel = stream(Side::kUnsprung).earliest();
  if (!body || !wheel) return false;
  const Stamp first = std::max(*body, *wheel);
  if (!origin_) origin_ = first;
  next_ = *origin_ + (first - *origin_ + period_ - Stamp(1)) / period_ * period_;
  return true;
}

// @return false: the road's readings of this instant may still come.
bool ResampledGrid::findRoad(Stamp t) {
  road_acceleration_.reset();
  if (!has_road_) return true;
  StreamResampler& road = stream(Side::kRoad);
  const Coverage coverage = road.look(t);
  if (coverage == Coverage::kCovered) road_acceleration_ = road.at(t).acceleration;
  if (coverage != Coverage::kComes) return true;
  const Stamp ahead = stream(Side::kSprung).newest()->stamp - t;
  road_is_silent_ = road_is_silent_ || ahead > (StreamResampler::kHalfWidth + kMostRoadLag) * period_;
  return road_is_silent_;
}

void ResampledGrid::startNewSeries() {
  for (StreamResampler& each : streams_) each.clear();
  origin_.reset();
  next_.reset();
}

}  // namespace suspension_health_monitor
