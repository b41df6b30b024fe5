#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

namespace suspension_health_monitor {

/// What sensor noise does to the strut's regression (28)-(30): it is in the regressors, too, and so pulls the
/// estimates. With noise n_z, n_w on the accelerometers and the filters' impulse responses h_2, h_1, h_0 of I_2^2,
/// I_1^2, I_0^2, row noise is h_2 * n_z for psi and h_i * (n_w - n_z) for phi. Source: the bias of least squares with
/// errors in the variables, e.g. Soderstrom, Automatica 43 (2007), 939-958.
class RegressorNoise {
 public:
  /// Of white noise, of the same variance on both.
  explicit RegressorNoise(const IntegralFilterOptions& options);

  /// Of other noise, as where a vehicle's struts are taken apart.
  /// @param noise  a long series of it, of sensors whose standard deviation is 1; empty: as above.
  RegressorNoise(const IntegralFilterOptions& options, const std::vector<CornerSample>& noise);

  /// @param theta  (b1 [1/s], b0 [1/s^2]).
  /// @param sensor_variance  of either sensor [(m/s^2)^2].
  /// @return E[phi e]: what R^-1 turns into the estimate's shift.
  Eigen::Vector2d moment(const Eigen::Vector2d& theta, double sensor_variance) const {
    return sensor_variance * (rows_.cross - rows_.regressors * theta);
  }

  /// @param variances  of the sensors on the body and on the wheel carrier [(m/s^2)^2], white.
  /// @return as moment().
  Eigen::Vector2d momentOf(const Eigen::Vector2d& theta, const Eigen::Vector2d& variances) const {
    return variances[0] * rows_.cross - 0.5 * variances.sum() * (rows_.regressors * theta);
  }

  /// @return standard deviation of moment() if nobody knows how the noise is divided between the sensors: of two that
  /// of a uniform distribution from all of it in the one to all of it in the other, with the same residual; of more a
  /// half.
  Eigen::Vector2d momentSpread(const Eigen::Vector2d& theta, double sensor_variance) const {
    if (!of_two_sensors_) return 0.5 * moment(theta, sensor_variance);
    const Eigen::Vector2d square = 0.5 * rows_.regressors * theta, cross = -rows_.cross;
    const double of_wheel = theta.dot(square), of_body = rows_.outputs + 2.0 * theta.dot(cross) + of_wheel;
    const double residual = sensor_variance * (of_wheel + of_body);
    return residual / std::sqrt(12.0) * (square / of_wheel - (cross + square) / of_body);
  }

  /// @return covariance that psi, phi_1 and phi_0 have of the noise, over the variance of a sensor.
  Eigen::Matrix3d covariance() const {
    Eigen::Matrix3d all;
    all << rows_.outputs, rows_.cross.transpose(), rows_.cross, rows_.regressors;
    return all;
  }

  /// @return variance of a row's residual over that of a sensor [-].
  double residualGain(const Eigen::Vector2d& theta) const { return rows_.gain(theta); }

  /// @return that of the residual's change from row to row [-].
  double changeGain(const Eigen::Vector2d& theta) const { return changes_.gain(theta); }

  /// @return that of the residual's mean (HorizonMean) [-].
  double meanGain(const Eigen::Vector2d& theta) const { return means_.gain(theta); }

  /// @return the part of that which is noise of the wheel's sensor: half of what phi_1 and phi_0 have of two.
  double wheelShareOfMean(const Eigen::Vector2d& theta) const {
    return 0.5 * theta.dot(means_.regressors * theta) / meanGain(theta);
  }

  /// @return variance that phi_0 has of the noise in its slow part (SlowMean), over that of a sensor [s^4].
  double slowGain() const { return slow_; }

  /// @return variance of psi of it, over that of a sensor [-].
  double outputGain() const { return rows_.outputs; }

  /// @return true if the noise is that of a vehicle's sensors, whose spectrum tells it from motion.
  bool isOfVehicle() const { return !of_two_sensors_; }

  /// @return variance that phi_i has of the noise, over that of a sensor [s^2] (damping), [s^4] (stiffness).
  double regressorGain(int i) const { return rows_.regressors(i, i); }

 private:
  /// Moments of the rows.
  struct Moments {
    Eigen::Matrix2d regressors = Eigen::Matrix2d::Zero();  // phi phi'
    Eigen::Vector2d cross = Eigen::Vector2d::Zero();       // phi psi
    double outputs = 0.0;                                  // psi psi

    void add(const Eigen::Vector3d& row, double weight);
    double gain(const Eigen::Vector2d& theta) const {
      return outputs - 2.0 * theta.dot(cross) + theta.dot(regressors * theta);
    }
  };

  bool of_two_sensors_ = true;
  Moments rows_, changes_, means_;
  double slow_ = 0.0;
};

}  // namespace suspension_health_monitor
