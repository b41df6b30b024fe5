#pragma once

#include <array>
#include <optional>

#include "suspension_health_monitor/internal/option_table.h"

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

inline constexpr std::array kQuarterCarFields{
    OptionField<QuarterCar>{"sprung_mass", "kg", "mass of the body above the strut, M", &QuarterCar::sprung_mass, 1e-9,
                            1e9},
    OptionField<QuarterCar>{"unsprung_mass", "kg", "mass of wheel and carrier, m", &QuarterCar::unsprung_mass, 1e-9,
                            1e9},
    OptionField<QuarterCar>{"damping", "N s/m", "damping coefficient of the strut, beta", &QuarterCar::damping, 0.0,
                            1e12},
    OptionField<QuarterCar>{"stiffness", "N/m", "spring rate of the strut, K", &QuarterCar::stiffness, 1e-9, 1e12},
    OptionField<QuarterCar>{"tyre_stiffness", "N/m", "tyre stiffness, K0; none: rigid wheel",
                            &QuarterCar::tyre_stiffness, 1e-9, 1e15},
};

/// @throws std::invalid_argument  naming the parameter, its value and what is allowed.
inline void validate(const QuarterCar& car) { validate(car, kQuarterCarFields); }

}  // namespace suspension_health_monitor
