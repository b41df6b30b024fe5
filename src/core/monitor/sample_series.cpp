#include "suspension_health_monitor/internal/monitor/sample_series.h"

#include <cmath>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriodTolerance = 0.02;  // an error of e makes b1 wrong by e and b0 by 2 e
constexpr double kSpacings = 50.0;         // before their mean counts: jitter of half a period shifts it by a hundredth

}  // namespace

SampleSeries::SampleSeries(Stamp period) : period_(period), spacing_(1.0 - 0.1 / kSpacings) {}

std::optional<Continuity> SampleSeries::add(const CornerSample& sample) {
  if (!isUsable(sample.sprung_acceleration) || !isUsable(sample.unsprung_acceleration)) {
    rejected_.add(RejectReason::kNotFinite);
    return std::nullopt;
  }
  const Continuity how = last_ ? continuity(sample.stamp - *last_, period_) : Continuity::kContinues;
  if (how == Continuity::kTooSoon) {
    rejected_.add(RejectReason::kTooSoon);
    return std::nullopt;
  }
  if (how == Continuity::kGap) ++status_.gaps;
  if (how == Continuity::kClockJumped) ++status_.restarts;
  if (!last_ || how != Continuity::kContinues) {
    recent_.clear();
  } else {
    spacing_.add(toSeconds(sample.stamp - *last_));
    status_.mean_period = spacing_.mean();
  }
  if (!first_ || how == Continuity::kClockJumped) first_ = sample.stamp;
  last_ = sample.stamp;
  ++status_.samples;
  recent_.push_back(sample);
  return how;
}

void SampleSeries::judge() {
  if (spacing_.weight() < kSpacings) return;
  status_.period_fits = std::abs(status_.mean_period / toSeconds(period_) - 1.0) <= kPeriodTolerance;
}

const CornerSample* SampleSeries::delayed() const { return recent_.full() ? &recent_.front() : nullptr; }

}  // namespace suspension_health_monitor
