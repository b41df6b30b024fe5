#include "suspension_health_monitor/internal/health/baseline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suspension_health_monitor {
namespace {

HealthyValue shifted(double value, double stddev, const DryFriction& friction, double gain_apart, double certain) {
  const double shift = friction.force * gain_apart;
  const double by_friction = std::hypot(shift / certain, friction.stddev * gain_apart);
  constexpr double kNoTelling = std::numeric_limits<double>::infinity();
  if (!(value + shift > by_friction)) return {{value, kNoTelling}, kNoTelling};  // nearly all of the value was friction
  return {{value + shift, std::hypot(stddev, by_friction)}, by_friction};
}

}  // namespace

Baseline baselineOf(const StrutEstimate& la, Stamp stamp) {
  return {la.damping_to_mass,
          la.stiffness_to_mass,
          la.damping_to_mass_stddev,
          la.stiffness_to_mass_stddev,
          la.friction,
          true,
          stamp,
          stamp};
}

HealthyValues onThisRoad(const Baseline& baseline, const std::optional<DryFriction>& now, double certain) {
  HealthyValues healthy;
  const DryFriction learned = baseline.friction.value_or(DryFriction{});
  const DryFriction present = baseline.friction && now ? *now : learned;
  const DryFriction between{(learned.force + present.force) / 2.0, std::hypot(learned.stddev, present.stddev) / 2.0};
  if (baseline.damping_to_mass)
    healthy.damping = shifted(*baseline.damping_to_mass, baseline.damping_to_mass_stddev, between,
                              present.damping_gain - learned.damping_gain, certain);
  if (baseline.stiffness_to_mass)
    healthy.stiffness = shifted(*baseline.stiffness_to_mass, baseline.stiffness_to_mass_stddev, between,
                                present.stiffness_gain - learned.stiffness_gain, certain);
  return healthy;
}

std::optional<Baseline> BaselineLearner::add(Stamp stamp, const StrutEstimate& estimate, double rows) {
  if (progress() == 0.0 || stamp < newest_) {  // another drive
    halves_[0] = halves_[1] = {};
    from_ = stamp;
  }
  newest_ = stamp;
  Half& half = halves_[halves_[0].rows >= rows_ / 2.0 ? 1 : 0];
  half.rows += rows;
  const double gain = rows / half.rows;
  const auto mix = [gain](double& mean, double value) { mean += gain * (value - mean); };
  mix(half.damping, estimate.damping_to_mass);
  mix(half.stiffness, estimate.stiffness_to_mass);
  mix(half.damping_variance, std::pow(estimate.damping_to_mass_stddev, 2));
  mix(half.stiffness_variance, std::pow(estimate.stiffness_to_mass_stddev, 2));
  const DryFriction friction = estimate.friction.value_or(DryFriction{});
  mix(half.friction.force, friction.force);
  mix(half.friction.damping_gain, friction.damping_gain);
  mix(half.friction.stiffness_gain, friction.stiffness_gain);
  mix(half.friction_variance, std::pow(friction.stddev, 2));
  if (progress() < 1.0) return std::nullopt;
  std::optional<Baseline> learned;
  if (drifts(&Half::damping, &DryFriction::damping_gain, &Half::damping_variance) ||
      drifts(&Half::stiffness, &DryFriction::stiffness_gain, &Half::stiffness_variance))
    ++restarts_;
  else
    learned = result(stamp);
  halves_[0] = halves_[1] = {};
  return learned;
}

bool BaselineLearner::drifts(double Half::*mean, double DryFriction::*gain, double Half::*variance) const {
  const auto& [a, b] = halves_;
  const auto withoutFriction = [&](const Half& half) { return half.*mean - friction() * half.friction.*gain; };
  const double first = withoutFriction(a), second = withoutFriction(b);
  const double difference = std::abs(second - first);
  const double correlated = std::min(1.0, 4.0 * memory_ / rows_);  // of half the rows
  return difference > kLeastDrift * std::abs(first) &&
         difference > kDrift * std::sqrt((a.*variance + b.*variance) * correlated);
}

Baseline BaselineLearner::result(Stamp to) const {
  const auto& [a, b] = halves_;
  const double correlated = std::min(1.0, 2.0 * memory_ / rows_);
  Baseline baseline;
  baseline.damping_to_mass = (a.damping + b.damping) / 2.0;
  baseline.stiffness_to_mass = (a.stiffness + b.stiffness) / 2.0;
  baseline.damping_to_mass_stddev = std::sqrt((a.damping_variance + b.damping_variance) / 2.0 * correlated);
  baseline.stiffness_to_mass_stddev = std::sqrt((a.stiffness_variance + b.stiffness_variance) / 2.0 * correlated);
  baseline.friction = DryFriction{friction(), std::sqrt((a.friction_variance + b.friction_variance) / 2.0 * correlated),
                                  (a.friction.damping_gain + b.friction.damping_gain) / 2.0,
                                  (a.friction.stiffness_gain + b.friction.stiffness_gain) / 2.0};
  baseline.learned = true;
  baseline.from = from_;
  baseline.to = to;
  return baseline;
}

}  // namespace suspension_health_monitor
