#include "suspension_health_monitor/internal/health/baseline.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

struct ValueAndVariance {
  double value, variance;
};

// b1 as it acts where friction has the gain m, without what is uncertain of friction's law.
ValueAndVariance dampingAt(double m, double b1, double stddev, const DryFriction& friction) {
  const double variance = std::max(0.0, square(stddev) - square(friction.lawStddev()));
  return {b1 + friction.force * m,
          std::max(0.0, variance + 2.0 * m * friction.damping_covariance + square(m * friction.stddev))};
}

// By how much estimates scatter beyond their own standard deviations, if that is no chance: of n windows a variance is
// known to sqrt(2 / n) of itself.
double scatterBeyond(double variance, double stddev, double windows) {
  constexpr double kCertain = 2.0;  // standard deviations
  const double expected = square(stddev);
  return variance > expected * (1.0 + kCertain * std::sqrt(2.0 / windows)) ? std::sqrt(variance - expected) : 0.0;
}

std::optional<LogChange> logChange(const ValueAndVariance& now, const ValueAndVariance& healthy) {
  if (!(now.value > 0.0 && healthy.value > 0.0)) return std::nullopt;
  return LogChange{std::log(now.value / healthy.value),
                   std::sqrt(now.variance / square(now.value) + healthy.variance / square(healthy.value))};
}

}  // namespace

Baseline baselineOf(const StrutEstimate& estimate, Stamp stamp) {
  return {estimate.damping_to_mass,
          estimate.stiffness_to_mass,
          estimate.damping_to_mass_stddev,
          estimate.stiffness_to_mass_stddev,
          0.0,
          0.0,
          estimate.friction,
          true,
          stamp,
          stamp};
}

ChangeFromBaseline changeFrom(const Baseline& healthy, const StrutEstimate& now) {
  ChangeFromBaseline result;
  // The model's error is the same at all times, but nominal values know nothing of it.
  const double damping_stddev =
      std::hypot(healthy.learned ? now.damping_to_mass_stddev : now.dampingAbsoluteStddev(), healthy.damping_scatter);
  const double stiffness_stddev = std::hypot(
      healthy.learned ? now.stiffness_to_mass_stddev : now.stiffnessAbsoluteStddev(), healthy.stiffness_scatter);
  MeasuredChange& change = result.change;
  if (healthy.stiffness_to_mass)
    change.stiffness = logChange({now.stiffness_to_mass, square(stiffness_stddev)},
                                 {*healthy.stiffness_to_mass, square(healthy.stiffness_to_mass_stddev)});
  if (!healthy.damping_to_mass) return result;
  ValueAndVariance damper{now.damping_to_mass, square(damping_stddev)};
  ValueAndVariance healthy_damper{*healthy.damping_to_mass, square(healthy.damping_to_mass_stddev)};
  double by_law = 0.0;
  if (healthy.friction && now.friction) {
    const DryFriction &present = *now.friction, &learned = *healthy.friction;
    const double between = (present.damping_gain + learned.damping_gain) / 2.0;
    damper = dampingAt(between, now.damping_to_mass, damping_stddev, present);
    healthy_damper = dampingAt(between, *healthy.damping_to_mass, healthy.damping_to_mass_stddev, learned);
    by_law = square((present.force - learned.force) * (present.damping_gain - learned.damping_gain) / 2.0);
    damper.variance += by_law;
  }
  change.damping = logChange(damper, healthy_damper);
  result.is_mostly_friction = by_law > 0.5 * damper.variance;
  // The error of b1 that it shares with b0; what friction adds it does not share.
  if (change.damping && change.stiffness && change.damping->stddev > 0.0 && change.stiffness->stddev > 0.0)
    change.correlation = now.correlation * damping_stddev / damper.value * stiffness_stddev / now.stiffness_to_mass /
                         (change.damping->stddev * change.stiffness->stddev);
  change.correlation = std::clamp(change.correlation, -0.99, 0.99);
  return result;
}

void BaselineLearner::Half::add(const StrutEstimate& estimate, double new_seconds) {
  seconds += new_seconds;
  const double gain = new_seconds / seconds;
  const auto mix = [gain](double& of, double value) { of += gain * (value - of); };
  // A few that are far off, as the first after a stop, are no scatter.
  const auto spread = [gain](double& variance, double mean_of, double value, double stddev) {
    constexpr double kMost = 4.0;  // standard deviations
    const double off = std::clamp(value - mean_of, -kMost * stddev, kMost * stddev);
    variance = (1.0 - gain) * (variance + gain * square(off));
  };
  const auto mixStddev = [gain](double& of, double value) {
    of = std::sqrt(square(of) + gain * (square(value) - square(of)));
  };
  if (mean.isEmpty()) mean = baselineOf(estimate, {});
  spread(damping_variance, *mean.damping_to_mass, estimate.damping_to_mass, estimate.damping_to_mass_stddev);
  spread(stiffness_variance, *mean.stiffness_to_mass, estimate.stiffness_to_mass, estimate.stiffness_to_mass_stddev);
  mix(*mean.damping_to_mass, estimate.damping_to_mass);
  mix(*mean.stiffness_to_mass, estimate.stiffness_to_mass);
  mixStddev(mean.damping_to_mass_stddev, estimate.damping_to_mass_stddev);
  mixStddev(mean.stiffness_to_mass_stddev, estimate.stiffness_to_mass_stddev);
  mix(window, estimate.window);
  if (!estimate.friction || !mean.friction) return mean.friction.reset();
  mix(mean.friction->force, estimate.friction->force);
  mix(mean.friction->damping_gain, estimate.friction->damping_gain);
  mix(mean.friction->damping_covariance, estimate.friction->damping_covariance);
  mixStddev(mean.friction->stddev, estimate.friction->stddev);
}

std::optional<Baseline> BaselineLearner::add(Stamp stamp, const StrutEstimate& estimate, double seconds) {
  if (progress() == 0.0 || stamp < newest_) {  // another drive
    halves_ = {};
    from_ = stamp - fromSeconds(seconds);
  }
  newest_ = stamp;
  halves_[halves_[0].seconds >= seconds_ / 2.0 ? 1 : 0].add(estimate, seconds);
  if (progress() < 1.0) return std::nullopt;
  std::optional<Baseline> learned;
  if (drifts())
    ++restarts_;
  else
    learned = result(stamp);
  halves_ = {};
  return learned;
}

double BaselineLearner::Half::dampingScatter() const {
  return scatterBeyond(damping_variance, mean.damping_to_mass_stddev, seconds / window);
}

double BaselineLearner::Half::stiffnessScatter() const {
  return scatterBeyond(stiffness_variance, mean.stiffness_to_mass_stddev, seconds / window);
}

double BaselineLearner::Half::dampingStddev() const {
  return std::hypot(mean.damping_to_mass_stddev, dampingScatter());
}

double BaselineLearner::Half::stiffnessStddev() const {
  return std::hypot(mean.stiffness_to_mass_stddev, stiffnessScatter());
}

bool BaselineLearner::drifts() const {
  const auto& [a, b] = halves_;
  const auto apart = [&](double first, double first_stddev, double second, double second_stddev) {
    const double difference = std::abs(second - first);
    const double variance = square(first_stddev) * std::min(1.0, a.window / a.seconds) +
                            square(second_stddev) * std::min(1.0, b.window / b.seconds);
    return difference > kLeastDrift * std::abs(first) && difference > kDrift * std::sqrt(variance);
  };
  const double gain =
      a.mean.friction && b.mean.friction ? (a.mean.friction->damping_gain + b.mean.friction->damping_gain) / 2.0 : 0.0;
  const auto damping = [&](const Baseline& mean) {
    return *mean.damping_to_mass + (mean.friction ? mean.friction->force * gain : 0.0);
  };
  return apart(damping(a.mean), a.dampingStddev(), damping(b.mean), b.dampingStddev()) ||
         apart(*a.mean.stiffness_to_mass, a.stiffnessStddev(), *b.mean.stiffness_to_mass, b.stiffnessStddev());
}

Baseline BaselineLearner::result(Stamp to) const {
  const auto& [a, b] = halves_;
  const auto middle = [](double first, double second) { return (first + second) / 2.0; };
  // Overlapping windows share readings; what friction's law leaves unknown no time removes.
  const double share = std::sqrt(std::min(1.0, middle(a.window, b.window) / seconds_));
  const auto rms = [&](double first, double second) { return std::sqrt(middle(square(first), square(second))); };
  const auto stddev = [&](double first, double second) { return share * rms(first, second); };
  Baseline baseline;
  baseline.damping_to_mass = middle(*a.mean.damping_to_mass, *b.mean.damping_to_mass);
  baseline.stiffness_to_mass = middle(*a.mean.stiffness_to_mass, *b.mean.stiffness_to_mass);
  baseline.damping_scatter = rms(a.dampingScatter(), b.dampingScatter());
  baseline.stiffness_scatter = rms(a.stiffnessScatter(), b.stiffnessScatter());
  baseline.damping_to_mass_stddev = stddev(a.dampingStddev(), b.dampingStddev());
  baseline.stiffness_to_mass_stddev = stddev(a.stiffnessStddev(), b.stiffnessStddev());
  if (a.mean.friction && b.mean.friction)
    baseline.friction =
        DryFriction{middle(a.mean.friction->force, b.mean.friction->force),
                    stddev(a.mean.friction->stddev, b.mean.friction->stddev),
                    middle(a.mean.friction->damping_gain, b.mean.friction->damping_gain),
                    square(share) * middle(a.mean.friction->damping_covariance, b.mean.friction->damping_covariance)};
  baseline.learned = true;
  baseline.from = from_;
  baseline.to = to;
  return baseline;
}

}  // namespace suspension_health_monitor
