#pragma once

#include <optional>

namespace suspension_health_monitor {

/// A value against the one of the healthy strut.
struct LogChange {
  double size;    ///< ln(value / healthy)
  double stddev;  ///< of size; NaN: not known
};

/// What has changed: body mass, damping, stiffness, each relative to the healthy strut (0: not at all).
struct StrutChange {
  std::optional<double> damping, stiffness;
  std::optional<double> payload;            ///< of the body's mass; empty: only one of the two parameters can be judged
  double damping_stddev, stiffness_stddev;  ///< of ln(1 + change); NaN: not known
};

/// Tells payload from damage. b1 = beta/M and b0 = K/M: a mass that is m times as large (ln m = p) moves both by -p,
/// damage moves one:  x1 = ln(b1/b1n) = d - p,  x0 = ln(b0/b0n) = s - p.
/// Of the many (p, d, s) that explain (x1, x0) this is the one of least |p| + |d| + |s|: p = -median(0, x1, x0). So
/// what both have in common is payload, and what one has beyond it is damage; where they move apart there is no
/// payload. The part that is not significant counts as none: p is shrunk by 1 - (2 sigma / p)^2, at least 0 (L.
/// Breiman, Better subset regression using the nonnegative garrote, 1995), so that the noise of b0 does not enter the
/// judgement of the damping of a vehicle without payload.
/// @param damping, stiffness  x1, x0; empty: cannot be judged.
/// @param payload_range  largest relative change of mass that can be payload; what is beyond is damage. 0: none is.
StrutChange splitChange(const std::optional<LogChange>& damping, const std::optional<LogChange>& stiffness,
                        double payload_range);

}  // namespace suspension_health_monitor
