#include "suspension_health_monitor/internal/health/strut_change.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

double median(double a, double b, double c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

LoadRange logRange(double range) { return {range < 1.0 ? std::log1p(-range) : -std::log1p(range), std::log1p(range)}; }

// The standard deviation of a part's change that makes it as significant as it is beside a load that explains all.
double beside(const LoadAlone& load, const LogChange& measured, double change, double apart) {
  if (!load.at_end || !(load.distance > 0.0)) return apart;
  return std::max(measured.stddev, std::abs(change) / load.distance);
}

}  // namespace

LoadAlone explainByLoad(const LogChange& damping, const LogChange& stiffness, const LoadRange& range) {
  const double of_damping = damping.stddev * damping.stddev, of_stiffness = stiffness.stddev * stiffness.stddev;
  const double best = -(damping.size * of_stiffness + stiffness.size * of_damping) / (of_damping + of_stiffness);
  LoadAlone load;
  load.log_mass = std::clamp(best, range.least, range.most);
  load.at_end = load.log_mass != best;
  load.distance = std::hypot((damping.size + load.log_mass) / damping.stddev,
                             (stiffness.size + load.log_mass) / stiffness.stddev);
  return load;
}

StrutChange splitChange(const std::optional<LogChange>& damping, const std::optional<LogChange>& stiffness,
                        double payload_range, double known_load) {
  StrutChange change{};
  change.measured_damping = damping;
  change.measured_stiffness = stiffness;
  change.damping_stddev = damping ? damping->stddev : NAN;
  change.stiffness_stddev = stiffness ? stiffness->stddev : NAN;
  double mass = 0.0;
  if (damping && stiffness && payload_range > 0.0) {
    const LoadRange range = logRange(payload_range);
    mass = std::clamp(median(known_load, -damping->size, -stiffness->size), range.least, range.most);
    change.load_alone = explainByLoad(*damping, *stiffness, range);
    const double apart = std::hypot(damping->stddev, stiffness->stddev);
    change.damping_stddev = beside(*change.load_alone, *damping, damping->size + mass, apart);
    change.stiffness_stddev = beside(*change.load_alone, *stiffness, stiffness->size + mass, apart);
  }
  if (damping && stiffness) change.payload = std::expm1(mass);
  if (damping) change.damping = std::expm1(damping->size + mass);
  if (stiffness) change.stiffness = std::expm1(stiffness->size + mass);
  return change;
}

}  // namespace suspension_health_monitor
