#include "suspension_health_monitor/internal/signal/resampled_grid.h"

#include <algorithm>

namespace suspension_health_monitor {

using Coverage = StreamResampler::Coverage;

bool ResampledGrid::next(GridStreams& streams, GridInstant& instant) {
  while (begin(streams)) {
    const Stamp t = *next_;
    const Coverage coverage = advanceRequired(t, streams);
    if (coverage == Coverage::kInterrupted) {
      next_.reset();
      continue;
    }
    if (coverage == Coverage::kComes || !takeOptional(t, streams, instant)) return false;
    next_ = t + period_;
    takeRequired(t, streams, instant);
    if (!streams.rejectStuck()) return true;
  }
  return false;
}

// @return false: a required stream has no readings.
bool ResampledGrid::begin(const GridStreams& streams) {
  if (next_) return true;
  std::optional<Stamp> first;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (!streams[i].options.required) continue;
    const std::optional<Stamp> earliest = resamplers_[i].earliest(streams[i].waiting);
    if (!earliest) return false;
    first = first ? std::max(*first, *earliest) : *earliest;
  }
  if (!origin_) origin_ = first;
  next_ = *origin_ + (*first - *origin_ + period_ - Stamp(1)) / period_ * period_;
  return true;
}

// @return kInterrupted or kComes if one of them is.
Coverage ResampledGrid::advanceRequired(Stamp t, GridStreams& streams) {
  bool is_interrupted = false, comes = false;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (!streams[i].options.required) continue;
    const Coverage coverage = resamplers_[i].advance(t, streams[i].waiting);
    if (coverage == Coverage::kInterrupted) {
      is_interrupted = true;
      ++streams[i].missed;
    }
    comes = comes || coverage == Coverage::kComes;
  }
  if (is_interrupted) return Coverage::kInterrupted;
  return comes ? Coverage::kComes : Coverage::kCovered;
}

// @return false: readings of an optional stream for this instant may still come.
bool ResampledGrid::takeOptional(Stamp t, GridStreams& streams, GridInstant& instant) {
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (streams[i].options.required) continue;
    const Coverage coverage = resamplers_[i].advance(t, streams[i].waiting);
    if (coverage == Coverage::kComes && streams.mayStillCome(streams[i])) return false;
    instant.measured[i] = coverage == Coverage::kCovered;
    if (instant.measured[i]) instant.values[i] = resamplers_[i].at(t).value;
  }
  return true;
}

void ResampledGrid::takeRequired(Stamp t, GridStreams& streams, GridInstant& instant) {
  instant.stamp = t;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (!streams[i].options.required) continue;
    const StreamResampler::Value value = resamplers_[i].at(t);
    instant.values[i] = value.value;
    instant.measured[i] = true;
    streams[i].is_still = value.still;
  }
}

void ResampledGrid::startNewSeries() {
  for (StreamResampler& each : resamplers_) each.clear();
  origin_.reset();
  next_.reset();
}

}  // namespace suspension_health_monitor
