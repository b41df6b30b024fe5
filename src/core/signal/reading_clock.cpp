#include "suspension_health_monitor/internal/signal/reading_clock.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "suspension_health_monitor/internal/signal/stream_timing.h"

namespace suspension_health_monitor {
namespace {

constexpr std::array kDifference{1.0, -4.0, 6.0, -4.0, 1.0};     // D
constexpr std::array kRate{3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0};  // of the readings 1, 2, 3 to either side
constexpr double kEven = 1e-3;                                   // of a period: no stamps that matter
constexpr double kFar = 5.0;                                     // mean sizes of e: beyond, a reading is wrong
constexpr int kBlockReadings = 32;                               // of which neighbouring blocks share a few only
constexpr double kMostBlocks = 300.0;   // that count: 5 minutes of readings at 30 Hz, one at 200 Hz
constexpr double kPriorBlocks = 6.0;    // fewer do not know how they scatter
constexpr double kPriorVariance = 1.0;  // of b: anything from 0 to 1, and taken for the end

}  // namespace

ReadingClock::ReadingClock() : size_(StreamTiming::kMemory) {}

void ReadingClock::passOver(Stamp stamp) {
  if (stamp != last_stamp_) regular_.passOver();
}

void ReadingClock::interrupt() {
  regular_.interrupt();
  last_.reset();
}

Stamp ReadingClock::take(Stamp stamp, double value) {
  if (!last_) origin_ = stamp;
  const double stamped = toSeconds(stamp - *origin_), regular = regular_.next(stamped);
  const double off = stamped - regular;
  last_stamp_ = stamp;
  values_.push(value);
  off_.push(off);
  if (regular_.inRow() >= kWindow && regular_.variance() > kEven * kEven * regular_.spacing() * regular_.spacing())
    compare();
  const Stamp taken = followsStamps() ? stamp : *origin_ + fromSeconds(regular);
  // One that was thought of a later period than it was comes half a period after the one before: what displaces a curve
  // through the readings least.
  const double apart = followsStamps() ? 0.0 : 0.5 * regular_.spacing();
  last_ = last_ ? std::max(taken, *last_ + std::max(Stamp(1), fromSeconds(apart))) : taken;
  return *last_;
}

double ReadingClock::rateAt(int i) const {
  const double* x = values_.data() + i;
  double change = 0.0;
  for (int j = 1; j <= kReach; ++j) change += kRate[static_cast<std::size_t>(j - 1)] * (x[j] - x[-j]);
  return change / regular_.spacing();
}

// Distances count from their mean: what the line is off by for all of these readings displaces none against another.
void ReadingClock::compare() {
  constexpr int kFirst = kReach, kTaken = 2 * kHalf + 1;
  double mean = 0.0, e = 0.0, r = 0.0;
  for (int i = 0; i < kTaken; ++i) mean += off_.data()[kFirst + i] / kTaken;
  for (int i = 0; i < kTaken; ++i) {
    const double weight = kDifference[static_cast<std::size_t>(i)];
    e += weight * values_.data()[kFirst + i];
    r += weight * rateAt(kFirst + i) * (off_.data()[kFirst + i] - mean);
  }
  const double size = std::abs(e), most = kFar * size_.mean();
  size_.add(size_.weight() > 0.0 ? std::min(size, most) : size);
  if (size > most && size_.weight() > kBlockReadings) return;
  block_.rr += r * r;
  block_.re += r * e;
  if (++rows_ == kBlockReadings) closeBlock();
}

void ReadingClock::closeBlock() {
  const double kept = 1.0 - 1.0 / kMostBlocks;
  all_ = {kept * all_.rr + block_.rr, kept * all_.re + block_.re};
  const double slope = all_.rr > 0.0 ? all_.re / all_.rr : 0.0, score = block_.re - slope * block_.rr;
  scores_ = kept * scores_ + score * score;
  blocks_ = kept * blocks_ + 1.0;
  block_ = {};
  rows_ = 0;
  if (!(scores_ > 0.0) || !std::isfinite(scores_)) return;
  const double trust = blocks_ * blocks_ / (blocks_ * blocks_ + kPriorBlocks * kPriorBlocks);
  const double information = trust * all_.rr / scores_ * all_.rr, prior = 1.0 / kPriorVariance;
  share_ = std::clamp((prior + information * slope) / (prior + information), 0.0, 1.0);
}

}  // namespace suspension_health_monitor
