#include "suspension_health_monitor/internal/health/strut_change.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

double median(double a, double b, double c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

LoadRange logRange(double range) { return {range < 1.0 ? std::log1p(-range) : -std::log1p(range), std::log1p(range)}; }

struct Load {
  double log_mass, stddev;
};

// What both have in common, as far as that is significant against the known load.
Load commonLoad(const LogChange& damping, const LogChange& stiffness, const LoadRange& range, double known) {
  const double common = median(known, -damping.size, -stiffness.size);
  const double stddev = common == -damping.size ? damping.stddev : stiffness.stddev;
  const double noise = stddev > 0.0 ? 2.0 * stddev : 0.0;
  if (std::abs(common - known) <= noise) return {known, 0.0};
  const double shrunk = known + (common - known) * (1.0 - std::pow(noise / (common - known), 2));
  return {std::clamp(shrunk, range.least, range.most), stddev};
}

}  // namespace

LoadAlone explainByLoad(const LogChange& damping, const LogChange& stiffness, const LoadRange& range) {
  const double of_damping = damping.stddev * damping.stddev, of_stiffness = stiffness.stddev * stiffness.stddev;
  const double best = -(damping.size * of_stiffness + stiffness.size * of_damping) / (of_damping + of_stiffness);
  LoadAlone load;
  load.log_mass = std::clamp(best, range.least, range.most);
  load.at_end = load.log_mass != best;
  load.distance =
      std::hypot((damping.size + load.log_mass) / damping.stddev, (stiffness.size + load.log_mass) / stiffness.stddev);
  return load;
}

StrutChange splitChange(const std::optional<LogChange>& damping, const std::optional<LogChange>& stiffness,
                        double payload_range, double known_load) {
  StrutChange change{};
  change.measured_damping = damping;
  change.measured_stiffness = stiffness;
  Load load{0.0, 0.0};
  if (damping && stiffness) {
    if (payload_range > 0.0) {
      const LoadRange range = logRange(payload_range);
      load = commonLoad(*damping, *stiffness, range, known_load);
      change.load_alone = explainByLoad(*damping, *stiffness, range);
    }
    change.payload = std::expm1(load.log_mass);
  }
  if (damping) change.damping = std::expm1(damping->size + load.log_mass);
  if (stiffness) change.stiffness = std::expm1(stiffness->size + load.log_mass);
  change.damping_stddev = damping ? std::hypot(damping->stddev, load.stddev) : NAN;
  change.stiffness_stddev = stiffness ? std::hypot(stiffness->stddev, load.stddev) : NAN;
  return change;
}

}  // namespace suspension_health_monitor
