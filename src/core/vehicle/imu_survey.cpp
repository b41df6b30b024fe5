#include "suspension_health_monitor/internal/vehicle/imu_survey.h"

#include <utility>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

void ImuSurvey::add(Stamp stamp, const Eigen::Vector3d& acceleration) {
  ++messages_;
  if (isKnown()) return judge(stamp, acceleration);
  first_.emplace_back(stamp, acceleration);
  if (first_.size() < kFewest) return;
  std::vector<Stamp> spacings;
  for (std::size_t i = 1; i < first_.size(); ++i) spacings.push_back(first_[i].first - first_[i - 1].first);
  const Stamp period = std::max(Stamp(1), medianInPlace(spacings));
  gates_.assign(3, StreamGate(period));
  period_.add(toSeconds(period));
  for (const auto& [time, reading] : std::exchange(first_, {})) judge(time, reading);
}

void ImuSurvey::judge(Stamp stamp, const Eigen::Vector3d& acceleration) {
  follow(stamp);
  bool passes = true;
  for (int i = 0; i < 3; ++i) {
    const double reading = acceleration[i];
    const bool is_new = gates_[i].judge(stamp, reading) != StreamGate::Verdict::kRejected;
    passes = passes && is_new;
    if (!is_new) continue;
    noise_[i].add(reading);
    largest_[i] = std::max(largest_[i], std::abs(reading));
  }
  if (passes) gravity_.add(stamp, acceleration);
}

void ImuSurvey::follow(Stamp stamp) {
  const double spacing = last_ ? toSeconds(stamp - *last_) : 0.0;
  last_ = stamp;
  taken_ += 1.0;
  if (spacing <= 0.0) return;
  const double periods = std::max(1.0, std::round(spacing / period_.mean()));
  if (periods > kSignalTuning.longest_batch) return;
  jitter_.add(square(spacing / period_.mean() - periods));
  lost_ += periods - 1.0;
  if (periods == 1.0) period_.add(spacing);
}

std::optional<MountClaim::Finding> ImuSurvey::gravity() const {
  const auto any = gravity_.find(Eigen::Vector3d::UnitZ());
  if (!any) return std::nullopt;
  return gravity_.find((any->is_negative ? -1.0 : 1.0) * Eigen::Vector3d::Unit(any->axis));
}

}  // namespace suspension_health_monitor
