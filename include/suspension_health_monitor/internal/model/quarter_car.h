#pragma once

#include <optional>

namespace suspension_health_monitor {

/// One wheel, its strut and the share of the body above it, paper section 2.1.
///
///   M z'' = beta (w' - z') + K (w - z)                          (1)
///   m w'' = -beta (w' - z') - K (w - z) - K0 (w - mu)           (2)
///
/// z sprung, w unsprung position, mu road height [m], up positive, all counted from the static equilibrium, so gravity
/// does not appear. Without a tyre stiffness the wheel is rigid (K0 -> infinity): w = mu, and m drops out.
struct QuarterCar {
  double sprung_mass = 50.0;             ///< M [kg]
  double unsprung_mass = 5.0;            ///< m [kg], without meaning for a rigid wheel
  double damping = 150.0;                ///< beta [N s/m]
  double stiffness = 690.0;              ///< K [N/m]
  std::optional<double> tyre_stiffness;  ///< K0 [N/m]; none: rigid wheel

  constexpr double dampingToMass() const { return damping / sprung_mass; }      ///< b1 [1/s]
  constexpr double stiffnessToMass() const { return stiffness / sprung_mass; }  ///< b0 [1/s^2]
};

}  // namespace suspension_health_monitor
