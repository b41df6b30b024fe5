#include "suspension_health_monitor/internal/signal/alignment_judge.h"

#include <cmath>

namespace suspension_health_monitor {

void AlignmentJudge::addInstant(Stamp reference) {
  const Stamp spacing = last_ ? reference - *last_ : Stamp::zero();
  last_ = reference;
  if (2 * spacing < 3 * period_ || spacing > kLongestLoss * period_) return;
  const double longest = kInterruptions * fill_ / std::log(2.0) * toSeconds(period_);
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
  if (++outcomes.lone_in_a_row > kLongestRow) return;
  ++outcomes.lone;
  judge(outcomes);
}

void AlignmentJudge::startNewSeries() {
  outcomes_.assign(outcomes_.size(), {});
  last_.reset();
  interruptions_.clear();
}

void AlignmentJudge::judge(Outcomes& outcomes) {
  if (outcomes.pairs + outcomes.lone < kOutcomes) return;
  if (verdict_ == Verdict::kDoesWell) {
    if (toSeconds(outcomes.apart) > kMostOffset * outcomes.pairs * toSeconds(period_)) verdict_ = Verdict::kApart;
    if (outcomes.lone > kMostLone * kOutcomes) verdict_ = Verdict::kLoneReadings;
  }
  outcomes.pairs = outcomes.lone = 0;
  outcomes.apart = {};
}

}  // namespace suspension_health_monitor
