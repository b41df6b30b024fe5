#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {

// What is known of any vehicle: its radius of gyration about an axis is the distance of the struts from it, but for a
// factor of two either way (one standard deviation). It matters only where rows leave S and bars open.
inline const double kLogInertia = 0.0, kLogInertiaStddev = 2.0 * std::log(2.0);

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
                const BodyRows& rows, double phi)
      : n_(q.rows()),
        m_(static_cast<int>(q.cols())),
        num_body_(m_ * (m_ + 1) / 2 - 1),
        share_(rows.is_by_body ? static_cast<double>(m_) / static_cast<double>(n_) : 1.0),
        q_(q),
        pairs_(pairs) {
    const int count = static_cast<int>(pairs.size());
    num_bar_stiffnesses_ = bars == BodyFitResult::Bars::kNone ? 0 : count;
    num_bar_dampings_ = bars == BodyFitResult::Bars::kStiffnessAndDamping ? count : 0;
    first_bar_stiffness_ = num_body_ + 2 * static_cast<int>(n_);
    first_bar_damping_ = first_bar_stiffness_ + num_bar_stiffnesses_;
    measured_.resize(n_, 2 * n_);
    measured_ << rows.rate, rows.travel;
    for (Eigen::Index i = 0; i < n_; ++i) {
      Eigen::MatrixXd covariance = rows.covariance[static_cast<std::size_t>(i)];
      const double rate = phi * rows.rate.row(i).cwiseAbs().maxCoeff();
      const double travel = phi * rows.travel.row(i).cwiseAbs().maxCoeff();
      covariance.diagonal().head(n_).array() += rate * rate;
      covariance.diagonal().tail(n_).array() += travel * travel;
      const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
      whitening_.push_back(std::sqrt(share_) * llt.matrixL().solve(Eigen::MatrixXd::Identity(2 * n_, 2 * n_)));
    }
  }

  int inputs() const { return first_bar_damping_ + num_bar_dampings_; }
  int values() const { return static_cast<int>(2 * n_ * n_) + m_ - 1; }
  /// Coefficients beyond parameters.
  double degreesOfFreedom() const { return share_ * 2.0 * static_cast<double>(n_ * n_) + m_ - 1 - inputs(); }

  int operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& distance) const {
    const Eigen::MatrixXd a = q_ * body(parameters) * q_.transpose();
    Eigen::MatrixXd model(n_, 2 * n_);
    model << a * struts(parameters, 0), a * struts(parameters, 1);
    for (Eigen::Index i = 0; i < n_; ++i)
      distance.segment(i * 2 * n_, 2 * n_) =
          whitening_[static_cast<std::size_t>(i)] * (model.row(i) - measured_.row(i)).transpose();
    for (int d = 1; d < m_; ++d)
      distance[2 * n_ * n_ + d - 1] = (parameters[bodyAt(d, d)] - kLogInertia) / kLogInertiaStddev;
    return 0;
  }

  int df(const Eigen::VectorXd& parameters, Eigen::MatrixXd& jacobian) const {
    jacobian.setZero(values(), inputs());
    const Eigen::MatrixXd s = body(parameters), a = q_ * s * q_.transpose();
    const Eigen::MatrixXd forces[] = {struts(parameters, 0), struts(parameters, 1)};
    Eigen::MatrixXd slope(n_, 2 * n_);
    const auto take = [&](int parameter) {
      for (Eigen::Index i = 0; i < n_; ++i)
        jacobian.col(parameter).segment(i * 2 * n_, 2 * n_) =
            whitening_[static_cast<std::size_t>(i)] * slope.row(i).transpose();
    };
    for (int row = 1; row < m_; ++row)
      for (int column = 0; column <= row; ++column) {
        Eigen::MatrixXd ds = Eigen::MatrixXd::Zero(m_, m_);
        ds(row, column) = ds(column, row) = row == column ? s(row, row) : 1.0;
        const Eigen::MatrixXd da = q_ * ds * q_.transpose();
        slope << da * forces[0], da * forces[1];
        take(bodyAt(row, column));
      }
    for (int kind = 0; kind < 2; ++kind) {
      for (Eigen::Index j = 0; j < n_; ++j) {
        slope.setZero();
        slope.col(kind * n_ + j) = a.col(j);
        take(firstStrut(kind) + static_cast<int>(j));
      }
      for (int p = 0; p < numBars(kind); ++p) {
        const auto i = static_cast<Eigen::Index>(pairs_[static_cast<std::size_t>(p)].first);
        const auto j = static_cast<Eigen::Index>(pairs_[static_cast<std::size_t>(p)].second);
        slope.setZero();
        slope.col(kind * n_ + i) = a.col(i) - a.col(j);
        slope.col(kind * n_ + j) = a.col(j) - a.col(i);
        take(firstBar(kind) + p);
      }
    }
    for (int d = 1; d < m_; ++d) jacobian(2 * n_ * n_ + d - 1, bodyAt(d, d)) = 1.0 / kLogInertiaStddev;
    return 0;
  }

  // The struts as if the body's centre of gravity were in their middle and its radii of gyration theirs.
  Eigen::VectorXd start(const BodyRows& rows) const {
    Eigen::VectorXd parameters = Eigen::VectorXd::Zero(inputs());
    const Eigen::VectorXd mobility = (q_ * body(parameters) * q_.transpose()).diagonal();
    parameters.segment(firstStrut(0), n_) = rows.rate.diagonal().cwiseQuotient(mobility);
    parameters.segment(firstStrut(1), n_) = rows.travel.diagonal().cwiseQuotient(mobility);
    return parameters;
  }

  Eigen::MatrixXd body(const Eigen::VectorXd& parameters) const {
    Eigen::MatrixXd s = Eigen::MatrixXd::Identity(m_, m_);
    for (int a = 1; a < m_; ++a)
      for (int b = 0; b <= a; ++b) {
        const double value = parameters[bodyAt(a, b)];
        s(a, b) = s(b, a) = a == b ? std::exp(value) : value;
      }
    return s;
  }

  /// @return diag + bars of one kind: 0 dampings, 1 stiffnesses.
  Eigen::MatrixXd struts(const Eigen::VectorXd& parameters, int kind) const {
    Eigen::MatrixXd result = parameters.segment(firstStrut(kind), n_).asDiagonal();
    for (int p = 0; p < numBars(kind); ++p) {
      const auto i = static_cast<Eigen::Index>(pairs_[static_cast<std::size_t>(p)].first);
      const auto j = static_cast<Eigen::Index>(pairs_[static_cast<std::size_t>(p)].second);
      const double value = parameters[firstBar(kind) + p];
      result(i, i) += value;
      result(j, j) += value;
      result(i, j) -= value;
      result(j, i) -= value;
    }
    return result;
  }

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
