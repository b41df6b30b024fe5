#include "suspension_health_monitor/internal/health/baseline.h"

#include <algorithm>

namespace suspension_health_monitor {
namespace {

// b1 as it acts where friction has the gain m, without what is uncertain of friction's law.
Measured dampingAt(double m, const Measured& b1, const DryFriction& friction) {
  const double variance = std::max(0.0, square(b1.stddev) - square(friction.lawStddev()));
  return {b1.value + friction.force * m,
          std::sqrt(std::max(0.0, variance + 2.0 * m * friction.damping_covariance + square(m * friction.stddev)))};
}

std::optional<Measured> logChange(const Measured& now, const Measured& healthy) {
  if (!(now.value > 0.0 && healthy.value > 0.0)) return std::nullopt;
  return Measured{std::log(now.value / healthy.value),
                  std::hypot(now.stddev / now.value, healthy.stddev / healthy.value)};
}

// Of two, `share` of the second.
DryFriction meanOf(const DryFriction& a, const DryFriction& b, double share) {
  const auto mean = [share](double of_a, double of_b) { return of_a + share * (of_b - of_a); };
  return {mean(a.force, b.force), std::sqrt(mean(square(a.stddev), square(b.stddev))),
          mean(a.damping_gain, b.damping_gain), mean(a.damping_covariance, b.damping_covariance),
          mean(a.stiffness_gain, b.stiffness_gain)};
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
          estimate.temperature ? std::optional(DamperTemperature{*estimate.temperature}) : std::nullopt,
          true,
          stamp,
          stamp};
}

Baseline nominalOf(const HealthThresholds& options) {
  Baseline nominal;
  nominal.damping_to_mass = options.nominal_damping_to_mass;
  nominal.stiffness_to_mass = options.nominal_stiffness_to_mass;
  if (options.nominal_friction)
    nominal.friction = DryFriction{*options.nominal_friction, 0.0, options.nominal_friction_gain.value_or(0.0)};
  return nominal;
}

MeasuredChange changeFrom(const Baseline& healthy, const StrutEstimate& now) {
  MeasuredChange change;
  // The model's error is the same at all times, but nominal values know nothing of it.
  const Measured b1{
      now.damping_to_mass,
      std::hypot(healthy.learned ? now.damping_to_mass_stddev : now.dampingAbsoluteStddev(), healthy.damping_scatter)};
  const Measured b0{now.stiffness_to_mass,
                    std::hypot(healthy.learned ? now.stiffness_to_mass_stddev : now.stiffnessAbsoluteStddev(),
                               healthy.stiffness_scatter)};
  if (healthy.stiffness_to_mass)
    change.stiffness = logChange(b0, {*healthy.stiffness_to_mass, healthy.stiffness_to_mass_stddev});
  if (!healthy.damping_to_mass) return change;
  Measured damper = b1, healthy_damper{*healthy.damping_to_mass, healthy.damping_to_mass_stddev};
  double by_law = 0.0;  // standard deviation
  if (healthy.friction && now.friction) {
    const DryFriction &present = *now.friction, &learned = *healthy.friction;
    const double between = (present.damping_gain + learned.damping_gain) / 2.0;
    damper = dampingAt(between, b1, present);
    healthy_damper = dampingAt(between, healthy_damper, learned);
    by_law = (present.force - learned.force) * (present.damping_gain - learned.damping_gain) / 2.0;
    damper.stddev = std::hypot(damper.stddev, by_law);
  }
  change.damping = logChange(damper, healthy_damper);
  if (change.damping && healthy.temperature && now.temperature) {
    const double warmer = *now.temperature - healthy.temperature->celsius;
    change.damping->value -= healthy.temperature->per_kelvin * warmer;
    change.damping->stddev = std::hypot(change.damping->stddev, healthy.temperature->per_kelvin_stddev * warmer);
  }
  change.is_mostly_friction = square(by_law) > 0.5 * square(damper.stddev);
  // The error of b1 that it shares with b0; what friction adds it does not share.
  if (change.damping && change.stiffness && change.damping->stddev > 0.0 && change.stiffness->stddev > 0.0)
    change.correlation = now.correlation * b1.stddev / damper.value * b0.stddev / b0.value /
                         (change.damping->stddev * change.stiffness->stddev);
  change.correlation = std::clamp(change.correlation, -0.99, 0.99);
  return change;
}

void BaselineLearner::Parameter::add(double value, double its_stddev, double gain) {
  // A few that are far off, as the first after a stop, are no scatter.
  const double off = std::clamp(value - mean, -kCertain * its_stddev, kCertain * its_stddev);
  variance = (1.0 - gain) * (variance + gain * square(off));
  mean += gain * (value - mean);
  stddev = std::sqrt(square(stddev) + gain * (square(its_stddev) - square(stddev)));
}

BaselineLearner::Parameter BaselineLearner::Parameter::with(const Parameter& other, double explained) const {
  Parameter both;
  both.mean = (mean + other.mean) / 2.0;
  both.stddev = std::sqrt((square(stddev) + square(other.stddev)) / 2.0);
  both.variance = (variance + other.variance) / 2.0 + square(other.mean - mean - explained) / 4.0;
  return both;
}

double BaselineLearner::Parameter::scatter(double windows) const {
  const double degrees = std::max(windows, 3.0);  // fewer have no variance
  return std::sqrt(std::max(0.0, variance * degrees / (degrees - 2.0) - square(stddev)));
}

void BaselineLearner::Half::add(const StrutEstimate& estimate, double new_seconds) {
  if (seconds == 0.0) {
    friction = estimate.friction;
    celsius = estimate.temperature;
  }
  seconds += new_seconds;
  const double gain = new_seconds / seconds;
  damping.add(estimate.damping_to_mass, estimate.damping_to_mass_stddev, gain);
  stiffness.add(estimate.stiffness_to_mass, estimate.stiffness_to_mass_stddev, gain);
  const auto mix = [gain](double& of, double value) { of += gain * (value - of); };
  mix(window, estimate.window);
  if (!estimate.temperature) celsius.reset();
  if (celsius) mix(*celsius, *estimate.temperature);
  if (!estimate.friction) friction.reset();
  if (friction) friction = meanOf(*friction, *estimate.friction, gain);
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

double BaselineLearner::Half::varianceOfMean(const Parameter& parameter) const {
  return square(parameter.spread()) * std::min(1.0, 1.0 / windows());
}

bool BaselineLearner::drifts() const {
  const Half &a = halves_[0], &b = halves_[1];
  const auto apart = [&](const Parameter& first, const Parameter& second, double warmth) {
    const double difference = std::abs(second.mean - first.mean);
    const double variance =
        a.varianceOfMean(first) + b.varianceOfMean(second) + square(warmth * (first.mean + second.mean) / 2.0);
    return difference > kLeastChange * std::abs(first.mean) && difference > kProven * std::sqrt(variance);
  };
  Parameter before = a.damping, after = b.damping;  // with what friction acts as
  if (a.friction && b.friction) {
    const double gain = (a.friction->damping_gain + b.friction->damping_gain) / 2.0;
    before.mean += a.friction->force * gain;
    after.mean += b.friction->force * gain;
  }
  const double warmth = a.celsius && b.celsius ? DamperTemperature::kPriorStddev * (*b.celsius - *a.celsius) : 0.0;
  return apart(before, after, warmth) || apart(a.stiffness, b.stiffness, 0.0);
}

// One measurement, ln(b1 of the second half / of the first) over the difference in temperature, and its prior.
std::optional<DamperTemperature> BaselineLearner::temperature() const {
  const Half &a = halves_[0], &b = halves_[1];
  if (!a.celsius || !b.celsius) return std::nullopt;
  const double warmer = *b.celsius - *a.celsius, prior = square(DamperTemperature::kPriorStddev);
  const double noise =
      a.varianceOfMean(a.damping) / square(a.damping.mean) + b.varianceOfMean(b.damping) / square(b.damping.mean);
  const double gain = prior * warmer / (prior * square(warmer) + noise);
  return DamperTemperature{(*a.celsius + *b.celsius) / 2.0, gain * std::log(b.damping.mean / a.damping.mean),
                           DamperTemperature::kPriorStddev * std::sqrt(1.0 - gain * warmer)};
}

Baseline BaselineLearner::result(Stamp to) const {
  const Half &a = halves_[0], &b = halves_[1];
  // Overlapping windows share readings; what friction's law leaves unknown no time removes.
  const double windows = std::max(1.0, 2.0 * seconds_ / (a.window + b.window));
  const double share = 1.0 / std::sqrt(windows);
  Baseline baseline;
  baseline.temperature = temperature();
  const double warmed =
      baseline.temperature ? baseline.temperature->per_kelvin * (*b.celsius - *a.celsius) * a.damping.mean : 0.0;
  const Parameter damping = a.damping.with(b.damping, warmed), stiffness = a.stiffness.with(b.stiffness, 0.0);
  baseline.damping_to_mass = damping.mean;
  baseline.stiffness_to_mass = stiffness.mean;
  baseline.damping_scatter = damping.scatter(windows);
  baseline.stiffness_scatter = stiffness.scatter(windows);
  baseline.damping_to_mass_stddev = share * damping.spread();
  baseline.stiffness_to_mass_stddev = share * stiffness.spread();
  if (a.friction && b.friction) {
    baseline.friction = meanOf(*a.friction, *b.friction, 0.5);
    baseline.friction->stddev *= share;
    baseline.friction->damping_covariance *= square(share);
  }
  baseline.learned = true;
  baseline.from = from_;
  baseline.to = to;
  return baseline;
}

}  // namespace suspension_health_monitor
