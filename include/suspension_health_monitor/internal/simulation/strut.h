#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// A parameter that goes in a straight line from its first value to its last one and is constant before and after.
struct Ramp {
  double first, last;
  double start, end;  ///< [s], start < end

  double at(double t) const;
};

/// End stops of the strut: springs that act only beyond a travel of +-gap.
struct EndStops {
  double gap;                ///< [m]
  double stiffness_to_mass;  ///< [1/s^2]

  /// @param travel  d [m], compression positive.
  /// @return force on the body per unit sprung mass [m/s^2], upwards in compression.
  double forcePerMass(double travel) const;
};

/// As many hidden effects a strut can have.
inline constexpr std::size_t kMostHiddenEffects = 4;

/// The true strut of a simulated drive: everything between wheel and body, equation (27) and what the model lacks.
struct Strut {
  Ramp damping_to_mass;      ///< b1 [1/s]
  double stiffness_to_mass;  ///< b0 [1/s^2]
  std::optional<EndStops> end_stops;
  std::vector<ActiveEffect> hidden;  ///< what the model lacks, at most kMostHiddenEffects

  /// The one place where the simulated force is written:  z'' = b1(t) v + b0 d + stops(d) + sum_j c_j f_j(d, v, t,
  /// s_j).
  /// @param travel  d [m], compression positive.
  /// @param travel_rate  v [m/s].
  /// @param t  time since the start of the drive [s].
  /// @param memory  one per hidden effect.
  /// @return force on the body per unit sprung mass, z'' [m/s^2].
  double forcePerMass(double travel, double travel_rate, double t, const Memory* memory) const;

  /// Rate of the j-th hidden effect's memory [1/s]; 0 if it has none.
  Memory memoryRate(std::size_t j, const StrutMotion& motion) const;
};

}  // namespace suspension_health_monitor
