#include "suspension_health_monitor/internal/health/level_confirmation.h"

#include <algorithm>

namespace suspension_health_monitor {
namespace {

// Both worse than `level`, or both better. Not being able to tell confirms nothing but itself.
bool confirmEachOther(HealthLevel level, HealthLevel a, HealthLevel b) {
  if ((a == HealthLevel::kStale) != (b == HealthLevel::kStale)) return false;
  return (a > level && b > level) || (a < level && b < level);
}

}  // namespace

HealthLevel LevelConfirmation::update(Stamp stamp, HealthLevel now) {
  if (now == confirmed_ && pending_ == confirmed_ && stamp >= pending_since_) return confirmed_;  // as nearly always
  if (stamp < pending_since_ || !confirmEachOther(confirmed_, now, pending_)) {
    pending_ = now;
    pending_since_ = stamp;
  } else {
    pending_ = now > confirmed_ ? std::min(now, pending_) : std::max(now, pending_);
  }
  if (now == confirmed_ || stamp - pending_since_ >= confirm_time_) confirmed_ = pending_;
  return confirmed_;
}

}  // namespace suspension_health_monitor
