#pragma once

#include <functional>
#include <string>
#include <vector>

namespace suspension_health_monitor {

/// What an effect may depend on, at one instant.
struct StrutMotion {
  double travel = 0.0;       ///< d [m], compression positive
  double travel_rate = 0.0;  ///< v [m/s]
  double time = 0.0;         ///< t [s] since the start of the drive
  double memory = 0.0;       ///< s, the effect's own state, 0 at the start
};

/// What a shape parameter is measured in: the search proposes values as multiples of what the drive shows.
enum class ShapeScale {
  kNone,        ///< a plain number
  kTravel,      ///< of the drive's rms travel [m]
  kTravelRate,  ///< of its rms travel rate [m/s]
  kTime         ///< of the strut's natural time 1/sqrt(b0) [s]
};

/// A number inside a law that does not enter linearly, such as the gap of a stop. Fitted offline, fixed online.
struct ShapeParameter {
  std::string name, unit;
  ShapeScale scale = ShapeScale::kNone;
  double min = 0.0, max = 0.0;  ///< in units of the scale, 0 < min < max
};

/// A physical effect that the linear strut lacks: an additional force on the body per unit mass,
///   z'' = b1 v + b0 d + c f(d, v, t, shapes, s),   s' = g(d, v, t, shapes, s).
struct ForceEffect {
  using Law = std::function<double(const StrutMotion&, const double* shapes)>;

  std::string name;
  std::string law;      ///< the formula for people, c included
  std::string unit;     ///< of the coefficient c
  std::string finding;  ///< what a workshop would find
  Law force;            ///< f, per unit of c
  std::vector<ShapeParameter> shapes = {};
  Law memory_rate = {};  ///< g [unit of s per second]; empty: no memory
};

}  // namespace suspension_health_monitor
