#pragma once

#include <algorithm>
#include <optional>
#include <utility>

namespace suspension_health_monitor {

/// A value against the one of the healthy strut.
struct LogChange {
  double size;    ///< ln(value / healthy)
  double stddev;  ///< of size; NaN: not known
};

/// @param range  the smallest and the largest of several changes.
/// @return what all of them have: the one nearest to none; 0 if they differ in sign.
inline double nearestToNone(const std::pair<double, double>& range) {
  return std::clamp(0.0, range.first, range.second);
}

/// Both parameters against those of the healthy strut.
struct MeasuredChange {
  std::optional<LogChange> damping, stiffness;  ///< x1, x0, of whatever cause; empty: cannot be judged
  double correlation = 0.0;                     ///< of the errors of x1 and x0 [-]
};

/// ln of the body's mass over that of the healthy vehicle, from the lightest to the heaviest that payload makes it.
struct LoadRange {
  double least, most;
};

/// The load that explains both changes best, and how well.
struct LoadAlone {
  double log_mass = 0.0;
  double distance = 0.0;  ///< of both changes from it, in standard deviations
};

/// What has changed: body mass, damping, stiffness, each relative to the healthy strut (0: not at all).
struct StrutChange {
  MeasuredChange measured;
  std::optional<double> damping, stiffness;
  std::optional<double> payload;            ///< of the body's mass; empty: only one of the two parameters can be judged
  double damping_stddev, stiffness_stddev;  ///< of ln(1 + change); NaN: not known
  std::optional<LoadAlone> load_alone;      ///< the rival of any damage; empty: there is none

  /// @return standard deviation of x1 - x0, of two that are measured.
  double apartStddev() const;
};

/// @param both  two that are measured.
/// @return by weighted least squares over the range, with the joint covariance.
LoadAlone explainByLoad(const MeasuredChange& both, const LoadRange& range);

/// Tells payload from damage. b1 = beta/M and b0 = K/M: a mass that is m times as large (ln m = p) moves both by -p,
/// damage moves one:  x1 = ln(b1/b1n) = d - p,  x0 = ln(b0/b0n) = s - p.
/// Of the many (p, d, s) that explain (x1, x0) this is the one of least |p - q| + |d| + |s|, with q the load that was
/// there before: p = median(q, -x1, -x0). So what both have in common is payload, and what one has beyond it is damage;
/// and a vehicle that was lighter and then has lost damping is not one that was loaded and has a stiffer spring. What
/// is not significant of p - q counts as none: it is shrunk by 1 - (2 sigma / (p - q))^2, at least 0 (L. Breiman,
/// Better subset regression using the nonnegative garrote, 1995), so that the noise of b0 does not enter the size of a
/// damage. Payload alone is the rival of every damage (explainByLoad()): a damage is no more significant than it is
/// certain that no payload explains the same. So a damping that is certainly lower is not yet the damper's fault as
/// long as the stiffness may be as much lower.
/// @param payload_range  largest relative change of mass that can be payload; what is beyond is damage. 0: none is.
/// @param known_load  q.
StrutChange splitChange(const MeasuredChange& measured, double payload_range, double known_load);

}  // namespace suspension_health_monitor
