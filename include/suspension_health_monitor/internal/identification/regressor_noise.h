#pragma once

#include <Eigen/Core>
#include <cmath>

#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

namespace suspension_health_monitor {

/// What sensor noise does to the strut's regression (28)-(30): it is in the regressors, too, and so pulls the
/// estimates. With white noise n_z, n_w of the same variance on both accelerometers and the filters' impulse responses
/// h_2, h_1, h_0 of I_2^2, I_1^2, I_0^2, row noise is h_2 * n_z for psi and h_i * (n_w - n_z) for phi. Source: the bias
/// of least squares with errors in the variables, e.g. Soderstrom, Automatica 43 (2007), 939-958.
class RegressorNoise {
 public:
  explicit RegressorNoise(const IntegralFilterOptions& options);

  /// @param theta  (b1 [1/s], b0 [1/s^2]).
  /// @param residual_variance  of a row [(m/s^2)^2], taken as sensor noise.
  /// @return E[phi e]: what R^-1 turns into the estimate's shift.
  Eigen::Vector2d moment(const Eigen::Vector2d& theta, double residual_variance) const {
    return residual_variance / residualGain(theta) * (-cross_ - 2.0 * (regressors_ * theta));
  }

  /// @return standard deviation of moment() if nobody knows how the noise is divided between the sensors, all of it in
  /// either of them or anything between: their difference over sqrt(12).
  Eigen::Vector2d momentSpread(const Eigen::Vector2d& theta, double residual_variance) const {
    const Eigen::Vector2d square = regressors_ * theta;
    const double of_wheel = theta.dot(square), of_body = outputs_ + 2.0 * theta.dot(cross_) + of_wheel;
    return residual_variance / std::sqrt(12.0) * (square / of_wheel - (cross_ + square) / of_body);
  }

  /// @return variance of a row's residual over that of a sensor [-].
  double residualGain(const Eigen::Vector2d& theta) const {
    return outputs_ + 2.0 * theta.dot(cross_) + 2.0 * theta.dot(regressors_ * theta);
  }

  /// @return variance that phi_i has of the noise, over that of a sensor [s^2] (damping), [s^4] (stiffness).
  double regressorGain(int i) const { return 2.0 * regressors_(i, i); }

 private:
  Eigen::Matrix2d regressors_;  // h_i' h_j
  Eigen::Vector2d cross_;       // h_i' h_2
  double outputs_;              // h_2' h_2
};

}  // namespace suspension_health_monitor
