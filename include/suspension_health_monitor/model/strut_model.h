#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/model/effect.h"
#include "suspension_health_monitor/model/measurement_effect.h"

namespace suspension_health_monitor {

/// An effect in use: with its coefficient and its shapes (SI).
struct ActiveEffect {
  ForceEffect effect;
  double coefficient = 0.0;
  std::vector<double> shapes;  ///< one per effect.shapes
};

/// A fault of the measurement, with its size.
struct ActiveMeasurementEffect {
  MeasurementEffect effect;
  std::vector<double> coefficients;  ///< one per effect.coefficients
};

/// The strut as it is modelled: z'' = b1 v + b0 d + sum_j c_j f_j, and how its acceleration is read.
struct StrutModel {
  double damping_to_mass = 0.0;    ///< b1 [1/s]
  double stiffness_to_mass = 0.0;  ///< b0 [1/s^2]
  std::vector<ActiveEffect> effects;
  std::vector<ActiveMeasurementEffect> reading;

  /// @param memory  one state per effect, those without memory included.
  /// @return z'' [m/s^2].
  double force(double travel, double travel_rate, double time, const double* memory) const {
    double sum = damping_to_mass * travel_rate + stiffness_to_mass * travel;
    for (std::size_t j = 0; j < effects.size(); ++j)
      sum += effects[j].coefficient *
             effects[j].effect.force({travel, travel_rate, time, memory[j]}, effects[j].shapes.data());
    return sum;
  }
};

}  // namespace suspension_health_monitor
