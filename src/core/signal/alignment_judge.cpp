#include "suspension_health_monitor/internal/signal/alignment_judge.h"

#include <cmath>

namespace suspension_health_monitor {

void AlignmentJudge::addPair(Stamp sprung, Stamp unsprung) {
  ++pairs_;
  lone_in_a_row_ = 0;
  apart_ += std::chrono::abs(sprung - unsprung);
  judgeInterruption(sprung);
  last_ = sprung;
  judgeOutcomes();
}

void AlignmentJudge::addLone() {
  if (++lone_in_a_row_ > kLongestRow) return;
  ++lone_;
  judgeOutcomes();
}

void AlignmentJudge::startNewSeries() {
  pairs_ = lone_ = lone_in_a_row_ = 0;
  apart_ = {};
  last_.reset();
  interruptions_.clear();
}

void AlignmentJudge::judgeInterruption(Stamp sprung) {
  if (!last_) return;
  const Stamp spacing = sprung - *last_;
  if (2 * spacing < 3 * period_ || spacing > kLongestLoss * period_) return;
  const double longest = kInterruptions * fill_ / std::log(2.0) * toSeconds(period_);
  const bool often = interruptions_.full() && toSeconds(sprung - interruptions_.front()) < longest;
  if (verdict_ == Verdict::kDoesWell && often) verdict_ = Verdict::kInterrupted;
  interruptions_.push_back(sprung);
}

void AlignmentJudge::judgeOutcomes() {
  if (pairs_ + lone_ < kOutcomes) return;
  if (verdict_ == Verdict::kDoesWell) {
    if (toSeconds(apart_) > kMostOffset * pairs_ * toSeconds(period_)) verdict_ = Verdict::kApart;
    if (lone_ > kMostLone * kOutcomes) verdict_ = Verdict::kLoneReadings;
  }
  pairs_ = lone_ = 0;
  apart_ = {};
}

}  // namespace suspension_health_monitor
