#pragma once

#include "suspension_health_monitor/internal/vehicle/imu_spectra.h"

namespace suspension_health_monitor {

/// An IMU that moves like the body over a wheel, which has the other.
struct BodyOverWheel {
  std::size_t body = 0, wheel = 0;  ///< places of the IMUs
  /// One reads upward, the other downward, by the axes that were given.
  bool is_reversed = false;
  /// The body's IMU is the one of this wheel alone, so that the numbers below are those of the strut, else of the body.
  bool is_own = true;
  double explained = 0.0;  ///< share of the body's motion by all wheels, weighted over frequency
  double damping_to_mass = 0.0, stiffness_to_mass = 0.0;  ///< b1 [1/s], b0 [1/s^2]
  double delay = 0.0;                                     ///< by which the body's clock is late [s]
};

/// Which IMUs are those of bodies, and over which wheels. A wheel shakes far more than the body above it, and what the
/// body does is what all wheels make of it through springs and dampers, (B20) in doc/equations.md: of the body at any
/// point i, with accelerations,
///     z_i'' = sum over wheels j of (b1_ij / s + b0_ij / s^2) w_j'' - (a_1 / s + a_0 / s^2) z_i'',
/// and likewise of its angular accelerations. The damper of a wheel pushes no point harder than the one above it: b1_ij
/// is largest there. An IMU with a gyro may serve several wheels, of which one may turn it and push it by nothing.
/// @return a pair for each wheel, by the wheels' places.
std::vector<BodyOverWheel> findBodiesOverWheels(const ImuSignals& signals);

}  // namespace suspension_health_monitor
