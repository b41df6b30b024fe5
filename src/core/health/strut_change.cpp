#include "suspension_health_monitor/internal/health/strut_change.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

struct Payload {
  double log_mass, stddev;
};

Payload payloadOf(const LogChange& damping, const LogChange& stiffness, double range) {
  if (range == 0.0 || (damping.size > 0.0) != (stiffness.size > 0.0)) return {0.0, 0.0};
  const LogChange& smaller = std::abs(damping.size) < std::abs(stiffness.size) ? damping : stiffness;
  const double noise = smaller.stddev > 0.0 ? 2.0 * smaller.stddev : 0.0;
  if (std::abs(smaller.size) <= noise) return {0.0, 0.0};
  const double shrunk = -smaller.size * (1.0 - std::pow(noise / smaller.size, 2));
  const double most = std::log1p(range), least = range < 1.0 ? std::log1p(-range) : -most;
  return {std::clamp(shrunk, least, most), smaller.stddev};
}

}  // namespace

StrutChange splitChange(const std::optional<LogChange>& damping, const std::optional<LogChange>& stiffness,
                        double payload_range) {
  StrutChange change{};
  Payload payload{0.0, 0.0};
  if (damping && stiffness) {
    payload = payloadOf(*damping, *stiffness, payload_range);
    change.payload = std::expm1(payload.log_mass);
  }
  if (damping) change.damping = std::expm1(damping->size + payload.log_mass);
  if (stiffness) change.stiffness = std::expm1(stiffness->size + payload.log_mass);
  const auto together = [&](double stddev) { return std::sqrt(stddev * stddev + payload.stddev * payload.stddev); };
  change.damping_stddev = damping ? together(damping->stddev) : NAN;
  change.stiffness_stddev = stiffness ? together(stiffness->stddev) : NAN;
  return change;
}

}  // namespace suspension_health_monitor
