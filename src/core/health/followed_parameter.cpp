#include "suspension_health_monitor/health/followed_parameter.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kTrendMemories = 2.25;  // long enough to be calm, short enough to bend; measured in doc/health.md
constexpr double kLagOfLa = 3.0;         // memories

double trendMemory(double memory) { return std::max(2.0, kTrendMemories * memory); }

std::optional<LogChange> changeOf(const std::optional<UncertainValue>& now, const UncertainValue& healthy) {
  if (!now || !(now->value > 0.0)) return std::nullopt;
  // Not std::hypot: its care for huge and tiny numbers would be most of the cost.
  const double of_value = now->stddev / now->value, of_healthy = healthy.stddev / healthy.value;
  return LogChange{std::log(now->value / healthy.value), std::sqrt(of_value * of_value + of_healthy * of_healthy)};
}

// The change that is known better; the other one if it is larger, and certain.
const LogChange& moreTelling(const LogChange& a, const LogChange& b, double certain) {
  const LogChange& known = a.stddev < b.stddev ? a : b;
  const LogChange& other = a.stddev < b.stddev ? b : a;
  const double size = std::abs(other.size);
  return size > std::abs(known.size) && size >= certain * other.stddev ? other : known;
}

}  // namespace

FollowedParameter::FollowedParameter(double memory, double horizon)
    : forgets_(std::isfinite(memory)),
      ls_(trendMemory(memory), memory + horizon),
      la_(trendMemory(memory), kLagOfLa * memory + horizon) {}

void FollowedParameter::setMemory(double memory, double horizon) {
  ls_.setMemory(trendMemory(memory), memory + horizon);
  la_.setMemory(trendMemory(memory), kLagOfLa * memory + horizon);
}

void FollowedParameter::follow(const std::optional<UncertainValue>& ls, const UncertainValue& la) {
  newest_ = la;
  if (!forgets_) return;
  if (ls) {
    // What LS and LA differ by beyond the noise counts as an error of LS: its own may not yet show the outlier.
    const double beyond = std::max(0.0, std::abs(ls->value - la.value) - ls->stddev);
    ls_.follow(ls->value, ls->stddev * ls->stddev + beyond * beyond);
  } else {
    ls_.pass();
  }
  la_.follow(la.value, la.stddev * la.stddev);
}

std::optional<LogChange> FollowedParameter::changeFrom(const UncertainValue& healthy, double certain) const {
  if (!forgets_) return changeOf(newest_, healthy);
  const std::optional<LogChange> by_ls = changeOf(ls_.now(), healthy), by_la = changeOf(la_.now(), healthy);
  if (!by_ls && !by_la) return changeOf(newest_, healthy);
  if (!by_ls || !by_la) return by_ls ? by_ls : by_la;
  return moreTelling(*by_ls, *by_la, certain);
}

}  // namespace suspension_health_monitor
