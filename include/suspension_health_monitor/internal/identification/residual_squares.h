#pragma once

#include <Eigen/Core>

namespace suspension_health_monitor {

/// What the best strut v = (1, -b1, -b0) leaves of psi, by the moments M of (psi, phi_1, phi_0).
struct ResidualSquares {
  double plain;  ///< least squares, min v' M v: a sum of squares of psi; 0 or less by rounding where nothing is left

  /// Total least squares, min v' M v / v' N v with N the moments of the noise of a row: how often that noise is in it;
  /// 0 where nothing is left.
  double of_noise;
};

/// Finds them by the determinant of M - x N, a cubic: the plain squares are its value at 0 over the minor of the
/// regressors, and total least squares its least root.
class ResidualSolver {
 public:
  /// @param noise  N; positive definite.
  explicit ResidualSolver(const Eigen::Matrix3d& noise);

  /// @param moments  M; symmetric, no eigenvalue negative but for rounding.
  /// @return NaN or an infinity in them if the moments have such, or their products have.
  ResidualSquares solve(const Eigen::Matrix3d& moments) const;

 private:
  Eigen::Matrix3d noise_, noise_adjugate_;
  double noise_determinant_;
};

}  // namespace suspension_health_monitor
