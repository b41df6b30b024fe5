#pragma once

#include <algorithm>
#include <vector>

namespace suspension_health_monitor {

/// Where the outermost nodes of a free-form law lie, in rms of the motion; beyond them it is constant.
inline constexpr double kOutermostNode = 2.5;

/// A piecewise linear function over `nodes` even nodes is a sum of hat functions, of which two are not 0 at any x.
/// Calls take(node, value) for these.
/// @param x  in rms of the motion.
template <class Take>
void forHatsAt(double x, int nodes, const Take& take) {
  const double spacing = 2.0 * kOutermostNode / (nodes - 1);
  const double at = (std::clamp(x, -kOutermostNode, kOutermostNode) + kOutermostNode) / spacing;
  const int below = std::min(nodes - 2, static_cast<int>(at));
  take(below, 1.0 - (at - below));
  take(below + 1, at - below);
}

/// The same over a grid of nodes x nodes, bilinear: take(node of x times nodes plus node of y, value).
template <class Take>
void forHatsAt(double x, double y, int nodes, const Take& take) {
  forHatsAt(x, nodes, [&](int i, double at_x) {
    forHatsAt(y, nodes, [&](int j, double at_y) { take(i * nodes + j, at_x * at_y); });
  });
}

/// Nodes either way of a free-form force over travel and travel rate.
inline constexpr int kForceNodes = 6;

/// By how much the motion of a free run is wrong, per sample.
struct MotionError {
  std::vector<double> travel, travel_rate;  ///< [m], [m/s]: to be taken off the run's
};

/// The residual r of a free run over one segment tells it: r integrated twice and once, by an integral that forgets
/// what is slower than a third of the natural frequency w0 (or drift would win): each is multiplied by
/// w^4 / (w^4 + (w0/3)^4), without a change of phase.
/// @param mean  of the residual, left out [m/s^2].  @param stiffness_to_mass  b0 > 0 [1/s^2].
MotionError motionError(const std::vector<double>& residual, double mean, double period, double stiffness_to_mass);

}  // namespace suspension_health_monitor
