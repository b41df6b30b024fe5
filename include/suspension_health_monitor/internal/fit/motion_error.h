#pragma once

#include <vector>

namespace suspension_health_monitor {

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
