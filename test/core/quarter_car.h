#pragma once

#include <optional>

#include "suspension_health_monitor/internal/simulation/scenario.h"

namespace suspension_health_monitor {

/// One wheel, its strut and the share of the body above it, paper section 2.1. By default the paper's.
struct QuarterCar {
  double sprung_mass = 50.0;             ///< M [kg]
  double unsprung_mass = 5.0;            ///< m [kg], without meaning for a rigid wheel
  double damping = 150.0;                ///< beta [N s/m]
  double stiffness = 690.0;              ///< K [N/m]
  std::optional<double> tyre_stiffness;  ///< K0 [N/m]; none: rigid wheel

  double dampingToMass() const { return damping / sprung_mass; }      ///< b1 [1/s]
  double stiffnessToMass() const { return stiffness / sprung_mass; }  ///< b0 [1/s^2]
};

/// @return the car of a simulated drive, as it is at the start.
inline QuarterCar carOf(const SimulationOptions& options) {
  const Vehicle car = quarterCarOf(options);
  const VehicleStrut& strut = car.struts.front();
  QuarterCar result{car.mass, strut.wheel_mass, strut.damping, strut.stiffness, {}};
  if (!strut.isRigid()) result.tyre_stiffness = strut.tyre_stiffness;
  return result;
}

}  // namespace suspension_health_monitor
