// How StreamGrid finds its next instant: by pairs, or by resampling.
#include <algorithm>

#include "suspension_health_monitor/internal/signal/stream_grid.h"

namespace suspension_health_monitor {

// @return true if instant_ is the next one; not as long as its readings are incomplete, or if pairing does badly.
bool StreamGrid::pairNext() {
  while (areWaiting() && !resamples()) {
    if (dropTooOld() || dropLoneReference()) continue;
    if (!optionalOnesAreReady()) return false;
    takePaired();
    if (!rejectStuck()) return true;
  }
  return false;
}

// @return true if a reading was dropped. One at a time, so that where the pairing ends does not depend on the order in
// which readings came.
bool StreamGrid::dropTooOld() {
  const Stamp stamp = reference().waiting.front().stamp;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    Stream& stream = streams_[i];
    if (!stream.required || 2 * (stamp - stream.waiting.front().stamp) <= period_) continue;
    stream.drop();
    ++reference().missed;
    if (judge_) judge_->addLone(i);
    return true;
  }
  return false;
}

// Nothing that waits is too old. @return true if the reference's reading was dropped, and with it its partners.
bool StreamGrid::dropLoneReference() {
  const Stamp stamp = reference().waiting.front().stamp;
  const auto isTooNew = [&](const Stream& stream) {
    return stream.required && 2 * (stream.waiting.front().stamp - stamp) > period_;
  };
  if (std::none_of(streams_.begin(), streams_.end(), isTooNew)) return false;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    Stream& stream = streams_[i];
    if (!stream.required || i == reference_) continue;
    if (isTooNew(stream)) {
      ++stream.missed;
      if (judge_) judge_->addLone(i);
    } else {
      if (judge_) judge_->addPair(i, stamp, stream.waiting.front().stamp);
      stream.drop();
    }
  }
  reference().drop();
  return true;
}

// @return false: an optional stream's reading of this instant may still come.
bool StreamGrid::optionalOnesAreReady() {
  const Stamp stamp = reference().waiting.front().stamp;
  for (Stream& stream : streams_) {
    if (stream.required) continue;
    while (!stream.waiting.empty() && 2 * (stamp - stream.waiting.front().stamp) > period_) stream.drop();
    if (stream.waiting.empty() && mayStillCome(stream)) return false;
  }
  return true;
}

void StreamGrid::takePaired() {
  instant_.stamp = reference().waiting.front().stamp;
  if (judge_) judge_->addInstant(instant_.stamp);
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    Stream& stream = streams_[i];
    const bool has_reading =
        stream.required || (!stream.waiting.empty() && 2 * (stream.waiting.front().stamp - instant_.stamp) <= period_);
    instant_.measured[i] = has_reading;
    if (!has_reading) continue;
    const SensorReading& reading = stream.waiting.front();
    if (judge_ && stream.required && i != reference_) judge_->addPair(i, instant_.stamp, reading.stamp);
    instant_.values[i] = reading.value;
    stream.is_still = reading.still;
    stream.waiting.pop_front();
  }
}

using Coverage = StreamResampler::Coverage;

// @return true if instant_ is the next one; not as long as the readings for it are incomplete.
bool StreamGrid::resampleNext() {
  while (beginSeries()) {
    const Stamp t = *next_;
    const Coverage coverage = advance(t);
    if (coverage == Coverage::kComes) return false;
    if (coverage == Coverage::kInterrupted) {
      next_.reset();
      continue;
    }
    next_ = t + period_;
    takeResampled(t);
    if (!rejectStuck()) return true;
  }
  return false;
}

// If there is none. @return false: a required stream has no readings.
bool StreamGrid::beginSeries() {
  if (next_) return true;
  std::optional<Stamp> first;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    if (!streams_[i].required) continue;
    const std::optional<Stamp> earliest = resamplers_[i].earliest(streams_[i].waiting);
    if (!earliest) return false;
    first = first ? std::max(*first, *earliest) : *earliest;
  }
  if (!origin_) origin_ = first;
  next_ = *origin_ + (*first - *origin_ + period_ - Stamp(1)) / period_ * period_;
  return true;
}

// @return of the required streams kInterrupted if one of them is, else kComes if one of them is, or if readings of an
// optional one may still come.
Coverage StreamGrid::advance(Stamp t) {
  Coverage all = Coverage::kCovered;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    if (!streams_[i].required) continue;
    const Coverage coverage = resamplers_[i].advance(t, streams_[i].waiting);
    if (coverage == Coverage::kInterrupted) ++streams_[i].missed;
    if (coverage == Coverage::kInterrupted || all == Coverage::kCovered) all = coverage;
    instant_.measured[i] = true;
  }
  if (all != Coverage::kCovered) return all;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    if (streams_[i].required) continue;
    const Coverage coverage = resamplers_[i].advance(t, streams_[i].waiting);
    if (coverage == Coverage::kComes && mayStillCome(streams_[i])) return Coverage::kComes;
    instant_.measured[i] = coverage == Coverage::kCovered;
  }
  return Coverage::kCovered;
}

void StreamGrid::takeResampled(Stamp t) {
  instant_.stamp = t;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    if (!instant_.measured[i]) continue;
    const StreamResampler::Value value = resamplers_[i].at(t);
    instant_.values[i] = value.value;
    streams_[i].is_still = value.still;
  }
}

}  // namespace suspension_health_monitor
