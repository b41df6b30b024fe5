#include "suspension_health_monitor/internal/signal/uniform_grid.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

// Before the conversion to whole nanoseconds, which is undefined for NaN and what does not fit.
Stamp checked(double period) {
  if (!(period >= 1e-9 && period <= 1e9))
    throw std::invalid_argument("sample_period = " + numberText(period) + " [s], must be in [1e-9, 1e9]");
  return fromSeconds(period);
}

}  // namespace

UniformGrid::UniformGrid(double period, const GridOptions& options)
    : period_(checked(period)),
      resamples_(options.alignment == Alignment::kResampled),
      paired_(period_, options),
      resampled_(period_, options.has_road),
      gates_{StreamGate(period_), StreamGate(period_), StreamGate(period_)} {}

std::optional<CornerSample> UniformGrid::push(Side side, Stamp stamp, double acceleration) {
  StreamGate& gate = gates_[static_cast<std::size_t>(side)];
  const StreamGate::Verdict verdict = gate.judge(stamp, acceleration);
  if (verdict == StreamGate::Verdict::kRejected) return std::nullopt;
  if (verdict == StreamGate::Verdict::kBeginsAnew) startNewSeries(side);
  ReadingQueue& queue = waiting_[side];
  if (queue.full()) paired_.drop(queue);
  queue.push_back({stamp, acceleration, gate.isStill(), gate.timing().period()});
  return next();
}

std::optional<CornerSample> UniformGrid::next() {
  if (!resamples_) {
    const std::optional<CornerSample> sample = paired_.next(waiting_);
    resamples_ = paired_.verdict() != AlignmentJudge::Verdict::kDoesWell;
    if (sample) return sample;
  }
  return resamples_ ? resampled_.next(waiting_) : std::nullopt;
}

// @param first  the stream whose clock went back before those of the others.
void UniformGrid::startNewSeries(Side first) {
  paired_.startNewSeries(waiting_);
  resampled_.startNewSeries();
  for (const Side side : {Side::kSprung, Side::kUnsprung, Side::kRoad})
    if (side != first) gates_[static_cast<std::size_t>(side)].startNewSeries();
}

std::string UniformGrid::whatIsTooSlow() const {
  const double spacing = std::max(gate(Side::kSprung).timing().period(), gate(Side::kUnsprung).timing().period());
  if (spacing < 1.5 * toSeconds(period_)) return "";
  std::ostringstream text;
  text.precision(4);
  text << "readings come every " << spacing << " s (" << 1.0 / spacing
       << " Hz), but sample_period = " << toSeconds(period_) << " [s]";
  return text.str();
}

std::string UniformGrid::why() const {
  const std::string slow = paired_.verdict() == AlignmentJudge::Verdict::kInterrupted ? whatIsTooSlow() : "";
  return slow.empty() ? describe(paired_.verdict()) : slow;
}

std::string UniformGrid::describeAlignment() const {
  if (!resamples_) return "paired";
  return why().empty() ? "resampled" : "resampled because " + why();
}

RejectCounts UniformGrid::rejected() const {
  RejectCounts all = paired_.rejected();
  all += resampled_.rejected();
  for (const StreamGate& gate : gates_) all += gate.rejected();
  return all;
}

}  // namespace suspension_health_monitor
