#include "suspension_health_monitor/internal/signal/alignment_judge.h"

#include <cmath>
#include <utility>

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
  interruptions_ = {};
}

void AlignmentJudge::judgeInterruption(Stamp sprung) {
  if (!last_) return;
  const Stamp spacing = sprung - *last_;
  if (2 * spacing < 3 * period_ || spacing > kLongestLoss * period_) return;
  const std::optional<Stamp> first = std::exchange(interruptions_[oldest_], sprung);
  oldest_ = (oldest_ + 1) % kInterruptions;
  const double longest = kInterruptions * fill_ / std::log(2.0) * toSeconds(period_);
  if (verdict_ == Verdict::kDoesWell && first && toSeconds(sprung - *first) < longest) verdict_ = Verdict::kInterrupted;
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

std::string describe(AlignmentJudge::Verdict verdict) {
  switch (verdict) {
    case AlignmentJudge::Verdict::kApart: return "the sensors read at different instants";
    case AlignmentJudge::Verdict::kLoneReadings: return "many readings find no partner: the sensors' rates differ";
    case AlignmentJudge::Verdict::kInterrupted:
      return "readings are lost so often that the integral filter would hardly ever be full";
    case AlignmentJudge::Verdict::kDoesWell: break;
  }
  return "";
}

}  // namespace suspension_health_monitor
