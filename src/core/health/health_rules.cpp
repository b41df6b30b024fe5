#include "suspension_health_monitor/internal/health/health_rules.h"

#include <algorithm>
#include <cmath>

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

EarlyWarning::EarlyWarning(double reference, double values_between_false_alarms)
    : reference_(reference), threshold_(std::log(2.0 * values_between_false_alarms)) {}

bool EarlyWarning::add(double change, double stddev) {
  if (!(stddev > 0.0)) return isOn();
  const double gain = 2.0 * reference_ / (stddev * stddev);
  fall_.add(gain * (-change - reference_), threshold_);
  rise_.add(gain * (change - reference_), threshold_);
  return isOn();
}

void EarlyWarning::Sum::add(double step, double threshold) {
  value = std::clamp(value + step, 0.0, 2.0 * threshold);  // an upper end, so that it comes back after a repair
  if (value >= threshold) on = true;
  if (value == 0.0) on = false;
}

LogChange ChangeTrend::carryOn(const LogChange& change, double age, double now, double window, double certain) {
  if (now < last_) restart();
  const double spacing = points_.empty() ? window : now - last_;
  last_ = now;
  const double new_share = std::min(1.0, spacing / window);
  points_.push_back({now - age, change.size, new_share / (change.stddev * change.stddev)});
  double weight = 0.0, time = 0.0, size = 0.0;
  for (const Point& point : points_) {
    weight += point.weight;
    time += point.weight * point.time;
    size += point.weight * point.size;
  }
  time /= weight;
  size /= weight;
  double information = 0.0, product = 0.0;
  for (const Point& point : points_) {
    information += point.weight * std::pow(point.time - time, 2);
    product += point.weight * (point.time - time) * (point.size - size);
  }
  if (!(product * product > certain * certain * information)) return change;
  const double slope = product / information;
  return {change.size + std::clamp(slope * age, -kMostCarried, kMostCarried),
          std::hypot(change.stddev, age / std::sqrt(information))};
}

}  // namespace suspension_health_monitor
