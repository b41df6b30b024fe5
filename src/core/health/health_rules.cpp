#include "suspension_health_monitor/internal/health/health_rules.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace suspension_health_monitor {
namespace {

using LoadRange = std::pair<double, double>;

LoadRange logRange(double range) { return {range < 1.0 ? std::log1p(-range) : -std::log1p(range), std::log1p(range)}; }

// What both have in common, as far as that is significant against the known load.
Measured commonLoad(const Measured& damping, const Measured& stiffness, const LoadRange& range, double known) {
  const auto [less, more] = std::minmax({-damping.value, -stiffness.value});
  const double common = std::clamp(known, less, more);
  const double stddev = common == -damping.value ? damping.stddev : stiffness.stddev;
  const double noise = stddev > 0.0 ? 2.0 * stddev : 0.0;
  if (std::abs(common - known) <= noise) return {known, 0.0};
  const double shrunk = known + (common - known) * (1.0 - std::pow(noise / (common - known), 2));
  return {std::clamp(shrunk, range.first, range.second), stddev};
}

// Both worse than `level`, or both better. Not being able to tell confirms nothing but itself.
bool confirmEachOther(HealthLevel level, HealthLevel a, HealthLevel b) {
  if ((a == HealthLevel::kStale) != (b == HealthLevel::kStale)) return false;
  return (a > level && b > level) || (a < level && b < level);
}

}  // namespace

double StrutChange::apartStddev() const {
  const double d = measured.damping->stddev, s = measured.stiffness->stddev;
  return std::sqrt(std::max(d * d + s * s - 2.0 * measured.correlation * d * s, 0.0));
}

double distanceFromLoad(const MeasuredChange& both, const LoadRange& range) {
  const double d = both.damping->stddev, s = both.stiffness->stddev, joint = both.correlation * d * s;
  Eigen::Matrix2d covariance;
  covariance << d * d, joint, joint, s * s;
  const Eigen::Matrix2d information = covariance.inverse();
  const Eigen::Vector2d measured(both.damping->value, both.stiffness->value), load_moves(-1.0, -1.0);
  const Eigen::Vector2d weights = information * load_moves;
  const double best = std::clamp(weights.dot(measured) / weights.dot(load_moves), range.first, range.second);
  const Eigen::Vector2d residual = measured - best * load_moves;
  return std::sqrt(std::max(residual.dot(information * residual), 0.0));  // of NaN, which is not known, NaN
}

StrutChange splitChange(const MeasuredChange& measured, double payload_range, double known_load) {
  const std::optional<Measured>&damping = measured.damping, &stiffness = measured.stiffness;
  StrutChange change{};
  change.measured = measured;
  Measured load{0.0, 0.0};  // of the mass
  if (damping && stiffness) {
    if (payload_range > 0.0) {
      const LoadRange range = logRange(payload_range);
      load = commonLoad(*damping, *stiffness, range, known_load);
      change.distance_from_load = distanceFromLoad(measured, range);
    }
    change.payload = std::expm1(load.value);
  }
  if (damping) change.damping = std::expm1(damping->value + load.value);
  if (stiffness) change.stiffness = std::expm1(stiffness->value + load.value);
  change.damping_stddev = damping ? std::hypot(damping->stddev, load.stddev) : NAN;
  change.stiffness_stddev = stiffness ? std::hypot(stiffness->stddev, load.stddev) : NAN;
  return change;
}

HealthReport reportOf(const StrutChange& change) {
  HealthReport report;
  report.damping_change = change.damping;
  report.stiffness_change = change.stiffness;
  report.payload_change = change.payload;
  report.damping_stddev = change.damping_stddev;
  report.stiffness_stddev = change.stiffness_stddev;
  return report;
}

HealthLevel LevelConfirmation::update(Stamp stamp, HealthLevel now, Stamp confirm_time) {
  if (stamp < pending_since_ || !confirmEachOther(confirmed_, now, pending_)) {
    pending_ = now;
    pending_since_ = stamp;
  } else {
    pending_ = now > confirmed_ ? std::min(now, pending_) : std::max(now, pending_);
  }
  if (now == confirmed_ || stamp - pending_since_ >= confirm_time) confirmed_ = pending_;
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

Measured ChangeTrend::carryOn(const Measured& change, double age, double now, double window) {
  if (now < last_) restart();
  const double spacing = points_.empty() ? window : now - last_;
  last_ = now;
  const double new_share = std::min(1.0, spacing / window);
  points_.push_back({now - age, change.value, new_share / (change.stddev * change.stddev)});
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
  if (!(product * product > square(kCertain) * information)) return change;
  const double slope = product / information;
  return {change.value + std::clamp(slope * age, -kLeastChange, kLeastChange),
          std::hypot(change.stddev, age / std::sqrt(information))};
}

}  // namespace suspension_health_monitor
