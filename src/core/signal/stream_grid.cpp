#include "suspension_health_monitor/internal/signal/stream_grid.h"

#include <algorithm>
#include <sstream>

#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

// Before the conversion to whole nanoseconds, which is undefined for NaN and what does not fit.
Stamp checked(double period) {
  requireIn("sample_period", period, "s", 1e-9, 1e9);
  return fromSeconds(period);
}

std::optional<AlignmentJudge> judgeFor(Alignment alignment, Stamp period, int fill_samples, std::size_t streams) {
  if (alignment != Alignment::kAuto) return std::nullopt;
  return AlignmentJudge(period, fill_samples, streams);
}

}  // namespace

StreamGrid::StreamGrid(double period, const std::vector<StreamOptions>& streams, Alignment alignment, int fill_samples)
    : period_(checked(period)),
      resamples_(alignment == Alignment::kResampled),
      streams_(period_, streams),
      paired_(period_, judgeFor(alignment, period_, fill_samples, streams.size())),
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
  for (GridStream& each : streams_)
    if (each.options.required && each.waiting.empty()) ++each.missed;
}

// @param first  the stream whose clock went back before those of the others.
void StreamGrid::startNewSeries(std::size_t first) {
  paired_.startNewSeries(streams_);
  resampled_.startNewSeries();
  for (std::size_t i = 0; i < streams_.size(); ++i)
    if (i != first) streams_[i].gate.startNewSeries();
}

std::string StreamGrid::whatIsTooSlow() const {
  double spacing = 0.0;
  for (const GridStream& each : streams_)
    if (each.options.required) spacing = std::max(spacing, each.gate.clock().period());
  if (spacing < 1.5 * toSeconds(period_)) return "";
  std::ostringstream text;
  text.precision(4);
  text << "readings come every " << spacing << " s (" << 1.0 / spacing
       << " Hz), but sample_period = " << toSeconds(period_) << " [s]";
  return text.str();
}

std::string StreamGrid::why() const {
  const std::string slow = paired_.verdict() == AlignmentJudge::Verdict::kInterrupted ? whatIsTooSlow() : "";
  return slow.empty() ? describe(paired_.verdict()) : slow;
}

std::string StreamGrid::describeAlignment() const {
  if (!resamples_) return "paired";
  return why().empty() ? "resampled" : "resampled because " + why();
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
