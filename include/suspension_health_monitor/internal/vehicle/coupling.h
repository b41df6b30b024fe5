#pragma once

#include <Eigen/Core>

#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

namespace suspension_health_monitor {

/// How the struts of a rigid body move one another. At the top of strut i
///   z_i'' = sum_j rho_ij p_j + sum_k kappa_ik x_k,   p_j = b1_j v_j + b0_j d_j + bars + effects of strut j,
/// with rho_ii = 1 and rho_ij = a_ij / a_jj, a_ij = 1/M + x_i x_j / Iyy + y_i y_j / Ixx: ratios that belong to the body
/// and to where the struts stand, not to what they are worth.
struct Coupling {
  StrutMatrix ratios;  ///< rho [-]
  ForceMatrix forces;  ///< kappa [m/s^2 per unit of the force: 1/kg of newtons]
  /// Anti-roll bars: b_ij (d_i - d_j) [1/s^2] is in p_i beside strut i's own, b_ij = a_ii times the bar's stiffness;
  /// the bar's force at j is the opposite. 0: there is none.
  StrutMatrix bars;
  StrutVector own_power;  ///< mean square of I_2^2 p_j, of the drive that it was learned from [(m/s^2)^2]
  StrutMatrix rest;       ///< moments of what it leaves of all I_2^2 z'', likewise; regular

  Eigen::Index numStruts() const { return ratios.rows(); }
};

}  // namespace suspension_health_monitor
