#include "suspension_health_monitor/internal/health/followed_parameter.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

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
