#include "suspension_health_monitor/internal/health/parameter_trend.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kUncorrelated = 20.0;  // memories or lags apart
constexpr double kNearOne = 1e-3;       // nearer to 1 the residues of autocovariance() cancel in all their digits

double apartFromOne(double r) { return std::abs(r - 1.0) < kNearOne ? 1.0 + kNearOne : r; }

// Autocovariance of the value now over t, in the units of correlatedShare(), up to a factor: the integral that is named
// there, with exp(i w t), by the residues at -1 and -1 / r.
double autocovariance(double r, double t) {
  const double r2 = r * r, a2 = (2.0 * r + 1.0) * (2.0 * r + 1.0);
  const double of_errors = (1.0 - a2) / (2.0 * (1.0 - r2) * (1.0 - r2)) * std::exp(-t);
  const double of_line = (r2 - a2) / (4.0 * r2 * (r2 - 1.0)) * std::exp(-t / r);
  return of_errors + of_line * (2.0 * a2 * r / (r2 - a2) - 2.0 * r / (r2 - 1.0) + r + t);
}

// Variance of the value now for errors with autocorrelation exp(-t), carried on over a time of 1, against the one that
// the normal equations give for uncorrelated ones, in continuous time with the memory r: the line has the frequency
// response (1 + (2 r + 1) s) / (1 + r s)^2, and 1/pi times the integral of its square over 1 + w^2 is [r (2 + r) + (2 r
// + 1)^2] / [2 r (1 + r)^2].
double correlatedShare(double r) {
  const double correlated = (r * (2.0 + r) + (2.0 * r + 1.0) * (2.0 * r + 1.0)) / (2.0 * r * (1.0 + r) * (1.0 + r));
  const double uncorrelated = (2.0 + (2.0 + 1.0 / r) / r) / r;
  return correlated / uncorrelated;
}

constexpr double kTrendMemories = 2.25;  // long enough to be calm, short enough to bend; measured in doc/health.md
constexpr double kLagOfLa = 3.0;         // memories

double lagOfLa(double memory, double horizon) { return kLagOfLa * memory + horizon; }

double trendMemory(double memory) { return std::max(2.0, kTrendMemories * memory); }

bool isStrut(const std::optional<UncertainValue>& now) { return now && now->value > 0.0; }

// Not std::hypot: its care for huge and tiny numbers would be most of the cost.
LogChange changeOf(const UncertainValue& now, const UncertainValue& healthy) {
  const double of_value = now.stddev / now.value, of_healthy = healthy.stddev / healthy.value;
  return {std::log(now.value / healthy.value), std::sqrt(of_value * of_value + of_healthy * of_healthy)};
}

// The change that is known better; the other one if it is larger, and certain.
LogChange moreTelling(const UncertainValue& a, const UncertainValue& b, const UncertainValue& healthy, double certain) {
  const bool a_is_known = a.stddev * b.value < b.stddev * a.value;
  const UncertainValue& known = a_is_known ? a : b;
  const UncertainValue& other = a_is_known ? b : a;
  // Rises with |ln|, of which one is enough.
  const auto distance = [&](double value) { return std::max(value / healthy.value, healthy.value / value); };
  if (distance(other.value) > distance(known.value)) {
    const LogChange change = changeOf(other, healthy);
    if (std::abs(change.size) >= certain * change.stddev) return change;
  }
  return changeOf(known, healthy);
}

}  // namespace

void ParameterTrend::setMemory(double memory, double lag) {
  memory_ = memory;
  lag_ = lag;
  correlated_ = lag * correlatedShare(memory / lag);
}

double ParameterTrend::varianceOfMeans(double memory, double lag, double steps) {
  const double ratio = apartFromOne(memory / lag);
  double sum = 0.0;
  for (double apart = steps; apart < kUncorrelated * std::max(memory, lag); apart += steps)
    sum += autocovariance(ratio, apart / lag);
  return 1.0 + 2.0 * sum / autocovariance(ratio, 0.0);
}

void ParameterTrend::follow(double value, double variance) {
  const double weight = 1.0 / variance;
  if (!(weight > 0.0) || !std::isfinite(weight) || !std::isfinite(value)) return pass();
  if (weight_ > 0.0) {
    const double error = value - line_.level - line_.slope, noise = variance + varianceAhead(1.0);
    if (error * error > kStep * kStep * noise) weight_ = age_ = age_squared_ = sum_ = sum_age_ = 0.0;
  }
  forget();
  weight_ += weight;
  sum_ += weight * value;
  fit();
}

void ParameterTrend::pass() {
  forget();
  if (weight_ > 0.0) fit();
}

// A step further, all are older by one.
void ParameterTrend::forget() {
  const double kept = 1.0 - 1.0 / memory_;
  age_squared_ = kept * (age_squared_ + 2.0 * age_ + weight_);
  age_ = kept * (age_ + weight_);
  sum_age_ = kept * (sum_age_ + sum_);
  weight_ *= kept;
  sum_ *= kept;
}

std::optional<UncertainValue> ParameterTrend::now() const {
  if (!(weight_ > 0.0)) return std::nullopt;
  const double most = kMostCarried * std::abs(line_.level);
  return UncertainValue{line_.level + std::clamp(line_.slope * lag_, -most, most), std::sqrt(varianceAhead(lag_))};
}

// Normal equations [weight, -age; -age, age_squared + prior] [a; b] = [sum; -sum_age]; the prior of the slope is that
// of kSlope of the mean per memory.
void ParameterTrend::fit() {
  const double per_slope = memory_ * weight_ / (kSlope * sum_);
  const double of_slope = age_squared_ + correlated_ * per_slope * per_slope;
  const double inverse = 1.0 / (weight_ * of_slope - age_ * age_);
  line_ = {(of_slope * sum_ - age_ * sum_age_) * inverse, (age_ * sum_ - weight_ * sum_age_) * inverse,
           correlated_ * of_slope * inverse, correlated_ * inverse};
}

FollowedParameter::FollowedParameter(double memory, double horizon)
    : forgets_(std::isfinite(memory)),
      ls_(trendMemory(memory), memory + horizon),
      la_(trendMemory(memory), lagOfLa(memory, horizon)) {}

void FollowedParameter::setMemory(double memory, double horizon) {
  ls_.setMemory(trendMemory(memory), memory + horizon);
  la_.setMemory(trendMemory(memory), lagOfLa(memory, horizon));
}

double FollowedParameter::varianceOfMeans(double memory, double horizon, double updates) {
  if (!std::isfinite(memory)) return 1.0;
  return ParameterTrend::varianceOfMeans(trendMemory(memory), lagOfLa(memory, horizon), updates);
}

void FollowedParameter::follow(const std::optional<UncertainValue>& ls, const UncertainValue& la) {
  newest_ = la;
  if (!forgets_) return;
  if (ls)
    ls_.follow(ls->value, ls->stddev * ls->stddev);
  else
    ls_.pass();
  la_.follow(la.value, la.stddev * la.stddev);
}

std::optional<LogChange> FollowedParameter::changeFrom(const UncertainValue& healthy, double certain) const {
  const std::optional<UncertainValue> ls = ls_.now(), la = la_.now();
  if (isStrut(ls) && isStrut(la)) return moreTelling(*ls, *la, healthy, certain);
  for (const std::optional<UncertainValue>& followed : {ls, la, newest_})
    if (isStrut(followed)) return changeOf(*followed, healthy);
  return std::nullopt;
}

}  // namespace suspension_health_monitor
