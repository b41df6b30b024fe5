#pragma once

#include <Eigen/Core>
#include <vector>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// The tops of all struts of a body as their rows have them:
///     z_i'' = sum_j (b1_ij d_j' + b0_ij d_j) + sum_k c_ik f_k,  d_j = w_j - z_j.
struct TopRows {
  Eigen::MatrixXd rate, travel;  ///< b1_ij [1/s], b0_ij [1/s^2], tops by struts
  Eigen::MatrixXd force;         ///< c_ik [m/s^2 per unit of the force], tops by known forces
};

/// What the rows of all tops say: how much the travel rate and the travel of every strut, and every known force, moves
/// every top, and how sure that is.
struct BodyRows : TopRows {
  Eigen::MatrixXd force_stddev;             ///< of c_ik
  std::vector<Eigen::MatrixXd> covariance;  ///< by top that of its rates, then its travels
  bool is_by_body = false;  ///< one IMU of the body tells of all tops: no more rows are independent than it has motions

  Eigen::Index size() const { return rate.rows(); }

  /// @return rho_ij, the share of what strut j does to its own top that it does to top i: the mean of b1_ij / b1_jj and
  /// b0_ij / b0_jj, weighted by their variances. Of a rigid body without anti-roll bars it is a_ij / a_jj.
  Measured ratio(Eigen::Index i, Eigen::Index j) const;
  /// @return true if every ratio is known well enough to take the other struts out.
  bool areKnown() const;
  /// @return the linear struts.
  std::vector<StrutModel> models() const;
};

}  // namespace suspension_health_monitor
