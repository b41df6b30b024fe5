#pragma once

#include <Eigen/Core>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {

/// The rows of a rigid body on struts as functions of its parameters, and their distance from rows that were measured,
/// in standard deviations: a functor of Eigen's Levenberg-Marquardt.
///
/// Parameters: S but for S_11 = 1, its diagonal by logarithms; c; k; k of bars; c of bars.
class RigidBodyRows {
 public:
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  using QRSolver = Eigen::ColPivHouseholderQR<JacobianType>;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  /// @param q  motions' shares in the tops, scaled.  @param phi  error of the model.
  RigidBodyRows(const Eigen::MatrixXd& q, const std::vector<StrutPair>& pairs, BodyFitResult::Bars bars,
                const BodyRows& rows, double phi);

  int inputs() const { return first_bar_damping_ + num_bar_dampings_; }
  int values() const { return static_cast<int>(2 * n_ * n_) + m_ - 1; }
  /// Coefficients beyond parameters.
  double degreesOfFreedom() const { return share_ * 2.0 * static_cast<double>(n_ * n_) + m_ - 1 - inputs(); }

  int operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& distance) const;
  int df(const Eigen::VectorXd& parameters, Eigen::MatrixXd& jacobian) const;

  Eigen::VectorXd start(const BodyRows& rows) const;

  Eigen::MatrixXd body(const Eigen::VectorXd& parameters) const;  ///< S
  /// @return diag + bars of one kind: 0 dampings, 1 stiffnesses.
  Eigen::MatrixXd struts(const Eigen::VectorXd& parameters, int kind) const;
  int firstStrut(int kind) const { return num_body_ + kind * static_cast<int>(n_); }
  int firstBar(int kind) const { return kind == 0 ? first_bar_damping_ : first_bar_stiffness_; }
  int numBars(int kind) const { return kind == 0 ? num_bar_dampings_ : num_bar_stiffnesses_; }
  /// Place of S_ab, a >= b, not both 0, among the parameters.
  static int bodyAt(int a, int b) { return a * (a + 1) / 2 + b - 1; }

 private:
  Eigen::Index n_;
  int m_, num_body_;
  double share_;  // of the rows that are independent
  int num_bar_stiffnesses_, num_bar_dampings_, first_bar_stiffness_, first_bar_damping_;
  Eigen::MatrixXd q_;
  std::vector<StrutPair> pairs_;
  Eigen::MatrixXd measured_;                // tops by rates and travels
  std::vector<Eigen::MatrixXd> whitening_;  // by top
};

}  // namespace suspension_health_monitor
