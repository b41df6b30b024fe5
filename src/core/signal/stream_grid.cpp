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

GridStreams::GridStreams(Stamp period, const std::vector<StreamOptions>& options) {
  const auto reference =
      std::find_if(options.begin(), options.end(), [](const StreamOptions& o) { return o.required; });
  if (reference == options.end()) throw std::invalid_argument("of the streams of a grid at least one must be required");
  reference_ = reference - options.begin();
  std::size_t sensors = 0;
  streams_.reserve(options.size());
  for (const StreamOptions& each : options) {
    streams_.emplace_back(period, each);
    sensors = std::max(sensors, each.sensor + 1);
  }
  sensor_is_still_.resize(sensors);
}

bool GridStreams::areWaiting() const {
  return std::none_of(streams_.begin(), streams_.end(),
                      [](const GridStream& stream) { return stream.options.required && stream.waiting.empty(); });
}

bool GridStreams::mayStillCome(GridStream& optional) const {
  const ReadingQueue& waiting = streams_[reference_].waiting;
  const Stamp lag = waiting.empty() ? Stamp::zero() : waiting.back().stamp - waiting.front().stamp;
  if (waiting.full() || lag > kMostOptionalLag) optional.is_silent = true;
  return !optional.is_silent;
}

bool GridStreams::rejectStuck() {
  std::fill(sensor_is_still_.begin(), sensor_is_still_.end(), true);
  const auto isCompared = [](const GridStream& stream) { return stream.options.required && !stream.options.is_force; };
  for (const GridStream& stream : streams_)
    if (isCompared(stream) && !stream.is_still) sensor_is_still_[stream.options.sensor] = false;
  bool stand_still = false, move = false;
  for (const GridStream& stream : streams_)
    if (isCompared(stream)) (sensor_is_still_[stream.options.sensor] ? stand_still : move) = true;
  if (!stand_still || !move) return false;
  for (GridStream& stream : streams_)
    if (isCompared(stream) && sensor_is_still_[stream.options.sensor]) stream.rejected.add(RejectReason::kStuck);
  return true;
}

namespace {

// Before the conversion to whole nanoseconds, which is undefined for NaN and what does not fit.
Stamp checked(double period) {
  requireIn("sample_period", period, "s", 1e-9, 1e9);
  return fromSeconds(period);
}

}  // namespace

StreamGrid::StreamGrid(double period, const std::vector<StreamOptions>& streams, Alignment alignment, int fill_samples)
    : period_(checked(period)),
      resamples_(alignment == Alignment::kResampled),
      streams_(period_, streams),
      paired_(period_, alignment == Alignment::kAuto
                           ? std::optional<AlignmentJudge>(std::in_place, period_, fill_samples, streams.size())
                           : std::nullopt),
      resampled_(period_, streams.size()),
      instant_{{}, std::vector<double>(streams.size()), std::vector<bool>(streams.size())} {}

const GridInstant* StreamGrid::push(std::size_t stream, Stamp stamp, double value) {
  GridStream& its = streams_[stream];
  const StreamGate::Verdict verdict = its.gate.judge(stamp, value);
  if (verdict == StreamGate::Verdict::kRejected) {
    taken_.reset();
    return nullptr;
  }
  if (verdict == StreamGate::Verdict::kBeginsAnew) startNewSeries(stream);
  if (its.waiting.full()) dropOldest(its);
  its.is_silent = false;
  taken_ = its.gate.taken();
  its.waiting.push_back({stamp, *taken_, value, its.gate.isStill(), its.gate.clock().period()});
  return next();
}

const GridInstant* StreamGrid::next() {
  if (!resamples_) {
    const bool found = paired_.next(streams_, instant_);
    resamples_ = paired_.verdict() != AlignmentJudge::Verdict::kDoesWell;
    if (found) return &instant_;
  }
  return resamples_ && resampled_.next(streams_, instant_) ? &instant_ : nullptr;
}

// Its readings have waited in vain for those of a sensor that is silent.
void StreamGrid::dropOldest(GridStream& full) {
  full.drop();
  for (GridStream& each : streams_) {
    const bool is_silent = each.waiting.empty() || each.waiting.back().stamp < full.waiting.front().stamp;
    if (each.options.required && is_silent) ++each.missed;
  }
}

// @param first  the stream whose clock went back before those of the others.
void StreamGrid::startNewSeries(std::size_t first) {
  paired_.startNewSeries(streams_);
  resampled_.startNewSeries();
  for (std::size_t i = 0; i < streams_.size(); ++i)
    if (i != first) streams_[i].gate.startNewSeries();
}

double StreamGrid::longestPeriod() const {
  double longest = 0.0;
  for (const GridStream& each : streams_)
    if (each.options.required) longest = std::max(longest, each.gate.clock().period());
  return longest;
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
