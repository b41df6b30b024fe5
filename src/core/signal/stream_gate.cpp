#include "suspension_health_monitor/signal/stream_gate.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

// A spike of this size takes an estimator with forgetting thousands of rows to forget; no road makes one.
constexpr double kAbsurdRatio = 1e6;
constexpr int kMostAbsurd = 3;  // in a row; after that it is how the sensor reads now
constexpr double kFewestForAbsurd = 10.0;  // soon: a spike among the first rows would be remembered longest

constexpr double kFewestForUsual = 100.0;
constexpr double kFarOut = 1.5;           // mean deviations from the mean: as far as a sine's peak
constexpr double kFineResolution = 0.02;  // step over span of a sensor whose repeated values mean something

}  // namespace

StreamGate::Verdict StreamGate::judge(Stamp stamp, double acceleration) {
  if (!isUsable(acceleration)) return reject(RejectReason::kNotFinite);
  const std::optional<RejectReason> fault = faultOfStamp(stamp);
  if (fault) rejected_.add(*fault);
  const bool went_far_back = fault == RejectReason::kTimeWentBack && *last_ - stamp > longest_overtaking_;
  if (fault && !went_far_back) return Verdict::kRejected;
  if (went_far_back) startNewSeries();
  const Verdict passes = went_far_back ? Verdict::kBeginsAnew : Verdict::kPasses;

  if (isAbsurd(acceleration)) return reject(RejectReason::kAbsurd);
  last_ = stamp;
  timing_.add(stamp);
  noteValue(acceleration);
  if (isClipped(acceleration)) return reject(RejectReason::kClipped);
  return passes;
}

void StreamGate::startNewSeries() {
  last_.reset();
  timing_.interrupt();
}

std::optional<RejectReason> StreamGate::faultOfStamp(Stamp stamp) const {
  if (!last_) return std::nullopt;
  if (stamp.count() == 0) return RejectReason::kZeroStamp;
  if (stamp == *last_) return RejectReason::kRepeatedStamp;
  if (stamp < *last_) return RejectReason::kTimeWentBack;
  return std::nullopt;
}

bool StreamGate::isAbsurd(double acceleration) {
  const double size = std::abs(acceleration);
  const bool absurd = size_.weight() >= kFewestForAbsurd && size_.mean() > 0.0 && size > kAbsurdRatio * size_.mean() &&
                      absurd_in_a_row_ < kMostAbsurd;
  absurd_in_a_row_ = absurd ? absurd_in_a_row_ + 1 : 0;
  if (!absurd) size_.add(size);
  return absurd;
}

void StreamGate::noteValue(double acceleration) {
  const double step = value_ ? std::abs(acceleration - *value_) : 0.0;
  equal_in_a_row_ = value_ && step == 0.0 ? std::min(equal_in_a_row_ + 1, kStill) : 1;
  if (step > 0.0) finest_step_ = finest_step_ > 0.0 ? std::min(finest_step_, step) : step;
  if (!value_) highest_ = lowest_ = acceleration;
  highest_ = std::max(highest_, acceleration);
  lowest_ = std::min(lowest_, acceleration);
  value_ = acceleration;
  mean_.add(acceleration);
  deviation_.add(std::abs(acceleration - mean_.mean()));
}

bool StreamGate::isClipped(double acceleration) {
  if (upper_limit_ && highest_ > *upper_limit_) upper_limit_.reset();
  if (lower_limit_ && lowest_ < *lower_limit_) lower_limit_.reset();
  const bool flat_top = equal_in_a_row_ >= kFlatTop && mean_.weight() >= kFewestForUsual &&
                        std::abs(acceleration - mean_.mean()) > kFarOut * deviation_.mean() &&
                        finest_step_ < kFineResolution * (highest_ - lowest_);
  // A sensor that reads 0 is dead: no range ends there.
  if (flat_top && acceleration != 0.0 && acceleration == highest_) upper_limit_ = acceleration;
  if (flat_top && acceleration != 0.0 && acceleration == lowest_) lower_limit_ = acceleration;
  return acceleration == upper_limit_ || acceleration == lower_limit_;
}

StreamGate::Verdict StreamGate::reject(RejectReason reason) {
  rejected_.add(reason);
  return Verdict::kRejected;
}

}  // namespace suspension_health_monitor
