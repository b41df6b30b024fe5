#include "suspension_health_monitor/internal/health/baseline.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

Baseline baselineOf(const StrutEstimate& la, Stamp stamp) {
  return {la.damping_to_mass,
          la.stiffness_to_mass,
          la.damping_to_mass_stddev,
          la.stiffness_to_mass_stddev,
          true,
          stamp,
          stamp};
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
  if (progress() < 1.0) return std::nullopt;
  const auto& [a, b] = halves_;
  std::optional<Baseline> learned;
  if (drifts(a.damping, b.damping, a.damping_variance + b.damping_variance) ||
      drifts(a.stiffness, b.stiffness, a.stiffness_variance + b.stiffness_variance))
    ++restarts_;
  else
    learned = result(stamp);
  halves_[0] = halves_[1] = {};
  return learned;
}

bool BaselineLearner::drifts(double first, double second, double variance) const {
  const double difference = std::abs(second - first);
  const double correlated = std::min(1.0, 4.0 * memory_ / rows_);  // of half the rows
  return difference > kLeastDrift * std::abs(first) && difference > kDrift * std::sqrt(variance * correlated);
}

Baseline BaselineLearner::result(Stamp to) const {
  const auto& [a, b] = halves_;
  const double correlated = std::min(1.0, 2.0 * memory_ / rows_);
  Baseline baseline;
  baseline.damping_to_mass = (a.damping + b.damping) / 2.0;
  baseline.stiffness_to_mass = (a.stiffness + b.stiffness) / 2.0;
  baseline.damping_to_mass_stddev = std::sqrt((a.damping_variance + b.damping_variance) / 2.0 * correlated);
  baseline.stiffness_to_mass_stddev = std::sqrt((a.stiffness_variance + b.stiffness_variance) / 2.0 * correlated);
  baseline.learned = true;
  baseline.from = from_;
  baseline.to = to;
  return baseline;
}

}  // namespace suspension_health_monitor
