#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

namespace suspension_health_monitor {

/// Why the coupling ratios do not tell how the body's mass is spread.
enum class InertiaDoubt {
  kNone,
  kNoPositions,  ///< it is not known where every strut stands
  kOnOneLine,    ///< fewer than three struts, or all on one line: they do not see the body turn about it
  kUncertain,    ///< the ratios are too uncertain, or do not fit the positions
};

/// A number and its standard deviation.
struct Measured {
  double value, stddev;
};

/// How a rigid body's mass is spread.
struct BodyInertia {
  Measured mass_to_pitch_inertia;  ///< M/Iyy [1/m^2]
  Measured mass_to_roll_inertia;   ///< M/Ixx [1/m^2]
  Measured x, y;                   ///< of the centre of gravity, from where positions count [m]
};

struct BodyInertiaResult {
  std::optional<BodyInertia> body;
  InertiaDoubt doubt = InertiaDoubt::kNone;
};

/// By strut x ahead and y to the left of the strut's top, from any one point of the body [m].
using StrutPlaces = std::vector<std::array<double, 2>>;

/// @return by the positions of a layout; empty unless every strut has one.
StrutPlaces placesOf(const VehicleLayout& layout);

/// M/Iyy and M/Ixx from coupling ratios rho_ij = a_ij / a_jj, doc/vehicle.md.
///
/// a_ij = 1/M + (x_i - x_c)(x_j - x_c) / Iyy + (y_i - y_c)(y_j - y_c) / Ixx with the centre of gravity x_c, y_c is,
/// over its value at the middle of the struts, 1 + A1 (x_i + x_j) + A2 (y_i + y_j) + A3 x_i x_j + A4 y_i y_j. So a_ij -
/// rho_ij a_jj = 0 is linear in A and tells where to begin; Gauss-Newton then minimises ((rho_ij - a_ij / a_jj) /
/// stddev_ij)^2. Standard deviations are by the errors of the ratios, taken as independent, and larger as far as the
/// ratios fit the positions worse than these errors let expect. Product of inertia Ixy is taken as 0.
/// @param ratios  rho_ij in row i; 1 for j = i.  @param stddevs  of these.
/// @param places  by strut; empty: not known.
BodyInertiaResult bodyInertia(const Eigen::MatrixXd& ratios, const Eigen::MatrixXd& stddevs, const StrutPlaces& places);

}  // namespace suspension_health_monitor
