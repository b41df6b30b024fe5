#include "suspension_health_monitor/internal/signal/stream_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/tuning.h"

namespace suspension_health_monitor {

void AlignmentJudge::addInstant(Stamp reference) {
  const Stamp spacing = last_ ? reference - *last_ : Stamp::zero();
  last_ = reference;
  if (2 * spacing < 3 * period_ || spacing > kSignalTuning.longest_loss * period_) return;
  const double longest = kSignalTuning.interruptions * fill_ / std::log(2.0) * toSeconds(period_);
  const bool often = interruptions_.full() && toSeconds(reference - interruptions_.front()) < longest;
  if (verdict_ == Verdict::kDoesWell && often) verdict_ = Verdict::kInterrupted;
  interruptions_.push_back(reference);
}

void AlignmentJudge::addPair(std::size_t stream, Stamp reference, Stamp partner) {
  Outcomes& outcomes = outcomes_[stream];
  ++outcomes.pairs;
  outcomes.lone_in_a_row = 0;
  outcomes.apart += std::chrono::abs(reference - partner);
  judge(outcomes);
}

void AlignmentJudge::addLone(std::size_t stream) {
  Outcomes& outcomes = outcomes_[stream];
  if (++outcomes.lone_in_a_row > kSignalTuning.longest_row) return;
  ++outcomes.lone;
  judge(outcomes);
}

void AlignmentJudge::startNewSeries() {
  outcomes_.assign(outcomes_.size(), {});
  last_.reset();
  interruptions_.clear();
}

void AlignmentJudge::judge(Outcomes& outcomes) {
  if (outcomes.pairs + outcomes.lone < kSignalTuning.outcomes) return;
  if (verdict_ == Verdict::kDoesWell) {
    if (toSeconds(outcomes.apart) > kSmall * outcomes.pairs * toSeconds(period_)) verdict_ = Verdict::kApart;
    if (outcomes.lone > kSmall * kSignalTuning.outcomes) verdict_ = Verdict::kLoneReadings;
  }
  outcomes.pairs = outcomes.lone = 0;
  outcomes.apart = {};
}

namespace {

// Before the conversion to whole nanoseconds, which is undefined for NaN and what does not fit.
Stamp checked(double period) {
  requireIn("sample_period", period, "s", 1e-9, 1e9);
  return fromSeconds(period);
}

std::size_t referenceOf(const std::vector<StreamOptions>& streams) {
  const auto first = std::find_if(streams.begin(), streams.end(), [](const StreamOptions& o) { return o.required; });
  if (first == streams.end()) throw std::invalid_argument("of the streams of a grid at least one must be required");
  return static_cast<std::size_t>(first - streams.begin());
}

}  // namespace

StreamGrid::StreamGrid(double period, const std::vector<StreamOptions>& streams, Alignment alignment, int fill_samples)
    : period_(checked(period)),
      never_pairs_(alignment == Alignment::kResampled),
      reference_(referenceOf(streams)),
      resamplers_(streams.size(), StreamResampler(period_)),
      instant_{{}, std::vector<double>(streams.size()), std::vector<bool>(streams.size())} {
  if (alignment == Alignment::kAuto) judge_.emplace(period_, fill_samples, streams.size());
  std::size_t sensors = 0;
  streams_.reserve(streams.size());
  for (const StreamOptions& each : streams) {
    streams_.push_back({each, StreamGate(period_, each.is_force)});
    sensors = std::max(sensors, each.sensor + 1);
  }
  sensor_is_still_.resize(sensors);
}

const GridInstant* StreamGrid::push(std::size_t stream, Stamp stamp, double value) {
  Stream& its = streams_[stream];
  const StreamGate::Verdict verdict = its.gate.judge(stamp, value);
  if (verdict == StreamGate::Verdict::kRejected) return nullptr;
  if (verdict == StreamGate::Verdict::kBeginsAnew) startNewSeries(stream);
  if (its.waiting.full()) dropOldest(its);
  its.is_silent = false;
  its.waiting.push_back({stamp, *its.gate.taken(), value, its.gate.isStill(), its.gate.clock().period()});
  return next();
}

const GridInstant* StreamGrid::next() {
  if (!resamples() && pairNext()) return &instant_;
  return resamples() && resampleNext() ? &instant_ : nullptr;
}

// Its readings have waited in vain for those of a sensor that is silent.
void StreamGrid::dropOldest(Stream& full) {
  full.drop();
  for (Stream& each : streams_) {
    const bool is_silent = each.waiting.empty() || each.waiting.back().stamp < full.waiting.front().stamp;
    if (each.required && is_silent) ++each.missed;
  }
}

// @param first  the stream whose clock went back before those of the others.
void StreamGrid::startNewSeries(std::size_t first) {
  if (judge_) judge_->startNewSeries();
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    while (!streams_[i].waiting.empty()) streams_[i].drop();
    resamplers_[i].clear();
    if (i != first) streams_[i].gate.startNewSeries();
  }
  origin_.reset();
  next_.reset();
}

// @return true if a reading of every required stream waits.
bool StreamGrid::areWaiting() const {
  return std::none_of(streams_.begin(), streams_.end(),
                      [](const Stream& stream) { return stream.required && stream.waiting.empty(); });
}

// Whether an optional stream, none of whose readings has come, is to be waited for.
bool StreamGrid::mayStillCome(Stream& optional) const {
  const ReadingQueue& waiting = streams_[reference_].waiting;
  const Stamp lag = waiting.empty() ? Stamp::zero() : waiting.back().stamp - waiting.front().stamp;
  if (waiting.full() || lag > kMostOptionalLag) optional.is_silent = true;
  return !optional.is_silent;
}

// Compares Stream::is_still of the required ones that are no forces.
// @return true if some sensors stand still while others move, which is then counted for those that are still.
bool StreamGrid::rejectStuck() {
  std::fill(sensor_is_still_.begin(), sensor_is_still_.end(), true);
  const auto isCompared = [](const Stream& stream) { return stream.required && !stream.is_force; };
  for (const Stream& stream : streams_)
    if (isCompared(stream) && !stream.is_still) sensor_is_still_[stream.sensor] = false;
  bool stand_still = false, move = false;
  for (const Stream& stream : streams_)
    if (isCompared(stream)) (sensor_is_still_[stream.sensor] ? stand_still : move) = true;
  if (!stand_still || !move) return false;
  for (Stream& stream : streams_)
    if (isCompared(stream) && sensor_is_still_[stream.sensor]) stream.rejected.add(RejectReason::kStuck);
  return true;
}

double StreamGrid::longestPeriod() const {
  double longest = 0.0;
  for (const Stream& each : streams_)
    if (each.required) longest = std::max(longest, each.gate.clock().period());
  return longest;
}

Stamp StreamGrid::settled() const {
  Stamp latest = Stamp::min();
  for (const Stream& each : streams_) latest = std::max(latest, each.gate.clock().settled());
  return latest;
}

RejectCounts StreamGrid::rejected(std::size_t stream) const {
  RejectCounts counts = streams_[stream].gate.rejected();
  counts += streams_[stream].rejected;
  return counts;
}

RejectCounts StreamGrid::rejected() const {
  RejectCounts all;
  for (std::size_t i = 0; i < streams_.size(); ++i) all += rejected(i);
  return all;
}

std::uint64_t StreamGrid::bridged() const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < streams_.size(); ++i) sum += bridged(i);
  return sum;
}

}  // namespace suspension_health_monitor
