#include "suspension_health_monitor/internal/signal/grids.h"

#include <algorithm>

namespace suspension_health_monitor {

bool PairedGrid::next(GridStreams& streams, GridInstant& instant) {
  while (streams.areWaiting() && verdict() == AlignmentJudge::Verdict::kDoesWell) {
    if (dropTooOld(streams) || dropLoneReference(streams)) continue;
    if (!optionalOnesAreReady(streams)) return false;
    take(streams, instant);
    if (!streams.rejectStuck()) return true;
  }
  return false;
}

// @return true if a reading was dropped. One at a time, so that where the pairing ends does not depend on the order in
// which readings came.
bool PairedGrid::dropTooOld(GridStreams& streams) {
  const Stamp stamp = streams.reference().waiting.front().stamp;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    GridStream& stream = streams[i];
    if (!stream.options.required || 2 * (stamp - stream.waiting.front().stamp) <= period_) continue;
    stream.drop();
    ++streams.reference().missed;
    if (judge_) judge_->addLone(i);
    return true;
  }
  return false;
}

// Nothing that waits is too old. @return true if the reference's reading was dropped, and with it its partners.
bool PairedGrid::dropLoneReference(GridStreams& streams) {
  const Stamp stamp = streams.reference().waiting.front().stamp;
  const auto isTooNew = [&](const GridStream& stream) {
    return stream.options.required && 2 * (stream.waiting.front().stamp - stamp) > period_;
  };
  if (std::none_of(streams.begin(), streams.end(), isTooNew)) return false;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    GridStream& stream = streams[i];
    if (!stream.options.required || i == streams.referenceIndex()) continue;
    if (isTooNew(stream)) {
      ++stream.missed;
      if (judge_) judge_->addLone(i);
    } else {
      if (judge_) judge_->addPair(i, stamp, stream.waiting.front().stamp);
      stream.drop();
    }
  }
  streams.reference().drop();
  return true;
}

// @return false: an optional stream's reading of this instant may still come.
bool PairedGrid::optionalOnesAreReady(GridStreams& streams) const {
  const Stamp stamp = streams.reference().waiting.front().stamp;
  for (GridStream& stream : streams) {
    if (stream.options.required) continue;
    while (!stream.waiting.empty() && 2 * (stamp - stream.waiting.front().stamp) > period_) stream.drop();
    if (stream.waiting.empty() && streams.mayStillCome(stream)) return false;
  }
  return true;
}

void PairedGrid::take(GridStreams& streams, GridInstant& instant) {
  instant.stamp = streams.reference().waiting.front().stamp;
  if (judge_) judge_->addInstant(instant.stamp);
  for (std::size_t i = 0; i < streams.size(); ++i) {
    GridStream& stream = streams[i];
    const bool has_reading = stream.options.required ||
                             (!stream.waiting.empty() && 2 * (stream.waiting.front().stamp - instant.stamp) <= period_);
    instant.measured[i] = has_reading;
    if (!has_reading) continue;
    const SensorReading& reading = stream.waiting.front();
    if (judge_ && stream.options.required && i != streams.referenceIndex())
      judge_->addPair(i, instant.stamp, reading.stamp);
    instant.values[i] = reading.value;
    stream.is_still = reading.still;
    stream.waiting.pop_front();
  }
}

void PairedGrid::startNewSeries(GridStreams& streams) {
  if (judge_) judge_->startNewSeries();
  for (GridStream& stream : streams)
    while (!stream.waiting.empty()) stream.drop();
}

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

// @return kInterrupted if one of them is, else kComes if one of them is.
Coverage ResampledGrid::advanceRequired(Stamp t, GridStreams& streams) {
  Coverage all = Coverage::kCovered;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (!streams[i].options.required) continue;
    const Coverage coverage = resamplers_[i].advance(t, streams[i].waiting);
    if (coverage == Coverage::kInterrupted) ++streams[i].missed;
    if (coverage == Coverage::kInterrupted || all == Coverage::kCovered) all = coverage;
  }
  return all;
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
