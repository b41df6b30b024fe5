#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {

/// A rigid body on struts and bars as functions of the parameters of a fit: S but for S_11 = 1, its diagonal by
/// logarithms; c; k; k of bars; c of bars.
class RigidBody {
 public:
  enum Kind { kDamping, kStiffness, kNumKinds };

  enum class Bars { kNone, kStiffness, kStiffnessAndDamping };

  /// Without bars.  @param places  as fitRigidBody().
  RigidBody(Eigen::Index struts, const StrutPlaces& places);

  Bars bars = Bars::kNone;                     ///< that it has
  std::vector<StrutPair> pairs;                ///< that a bar may join
  bool sees_pitch = false, sees_roll = false;  ///< struts stand so that they see the body turn

  int numStruts() const { return static_cast<int>(q_.rows()); }
  int numMotions() const { return static_cast<int>(q_.cols()); }
  int numBars(int kind) const {
    const bool has = kind == kDamping ? bars == Bars::kStiffnessAndDamping : bars != Bars::kNone;
    return has ? static_cast<int>(pairs.size()) : 0;
  }

  // Places among the parameters; S_ab with a >= b, not both 0.
  static int bodyAt(int a, int b) { return a * (a + 1) / 2 + b - 1; }
  int firstStrut(int kind) const { return bodyAt(numMotions(), 0) + kind * numStruts(); }
  int firstBar() const { return firstStrut(kNumKinds); }
  int firstBar(int kind) const { return firstBar() + (kind == kDamping ? numBars(kStiffness) : 0); }
  int numParameters() const { return firstBar(kDamping) + numBars(kDamping); }

  /// @return S.
  Eigen::MatrixXd inertia(const Eigen::VectorXd& parameters) const {
    Eigen::MatrixXd s = Eigen::MatrixXd::Identity(numMotions(), numMotions());
    for (int a = 1; a < numMotions(); ++a)
      for (int b = 0; b <= a; ++b) {
        const double value = parameters[bodyAt(a, b)];
        s(a, b) = s(b, a) = a == b ? std::exp(value) : value;
      }
    return s;
  }

  /// @return Q S Q': what forces at the tops make of the tops.
  Eigen::MatrixXd mobility(const Eigen::MatrixXd& s) const { return q_ * s * q_.transpose(); }

  /// @return diag + bars of one kind.
  Eigen::MatrixXd struts(const Eigen::VectorXd& parameters, int kind) const {
    Eigen::MatrixXd result = parameters.segment(firstStrut(kind), numStruts()).asDiagonal();
    for (int p = 0; p < numBars(kind); ++p) {
      const auto [i, j] = pairs[p];
      const double value = parameters[firstBar(kind) + p];
      result(i, i) += value;
      result(j, j) += value;
      result(i, j) -= value;
      result(j, i) -= value;
    }
    return result;
  }

  /// @return what that mobility makes of the struts and bars: rates, then travels.
  Eigen::MatrixXd rows(const Eigen::MatrixXd& mobility, const Eigen::VectorXd& parameters) const {
    Eigen::MatrixXd result(numStruts(), 2 * numStruts());
    result << mobility * struts(parameters, kDamping), mobility * struts(parameters, kStiffness);
    return result;
  }
  /// @return the rows of the tops.
  Eigen::MatrixXd rows(const Eigen::VectorXd& parameters) const {
    return rows(mobility(inertia(parameters)), parameters);
  }

  /// @return M/Iyy, M/Ixx, x and y of the centre of gravity; 0 what is not seen.
  Eigen::Vector4d massAndPlace(const Eigen::VectorXd& parameters) const;
  /// @return false: no vehicle has a body with such numbers. Laws with memory may look like bars; the body that
  /// fits together with such bars is none of a vehicle.
  bool isVehicle(const Eigen::VectorXd& parameters) const;

 private:
  Eigen::MatrixXd q_;                                                                   // struts by motions, scaled
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero(), scale_ = Eigen::Vector2d::Ones();  // of x, y
};

// What is known of any vehicle: its radius of gyration about an axis is the distance of the struts from it, but for a
// factor of two either way (one standard deviation). It matters only where rows leave S and bars open.
inline const double kLogInertiaStddev = 2.0 * std::log(2.0);

/// The distance of a rigid body's rows from rows that were measured, in standard deviations: a functor of Eigen's
/// Levenberg-Marquardt.
class RigidBodyRows {
 public:
  /// @param phi  error of the model.
  RigidBodyRows(const RigidBody& body, const BodyRows& rows, double phi)
      : body_(body),
        n_(body.numStruts()),
        m_(body.numMotions()),
        share_(rows.is_by_body ? static_cast<double>(m_) / static_cast<double>(n_) : 1.0),
        measured_(n_, 2 * n_) {
    measured_ << rows.rate, rows.travel;
    for (Eigen::Index i = 0; i < n_; ++i) {
      Eigen::MatrixXd covariance = rows.covariance[i];
      const double rate = phi * rows.rate.row(i).cwiseAbs().maxCoeff();
      const double travel = phi * rows.travel.row(i).cwiseAbs().maxCoeff();
      covariance.diagonal().head(n_).array() += rate * rate;
      covariance.diagonal().tail(n_).array() += travel * travel;
      const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
      whitening_.push_back(std::sqrt(share_) * llt.matrixL().solve(Eigen::MatrixXd::Identity(2 * n_, 2 * n_)));
    }
  }

  int inputs() const { return body_.numParameters(); }
  int values() const { return static_cast<int>(2 * n_ * n_) + m_ - 1; }
  /// Coefficients beyond parameters.
  double degreesOfFreedom() const { return share_ * 2.0 * static_cast<double>(n_ * n_) + m_ - 1 - inputs(); }

  int operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& distance) const {
    whiten(body_.rows(parameters) - measured_, distance);
    for (int d = 1; d < m_; ++d)
      distance[2 * n_ * n_ + d - 1] = parameters[RigidBody::bodyAt(d, d)] / kLogInertiaStddev;
    return 0;
  }

  int df(const Eigen::VectorXd& parameters, Eigen::MatrixXd& jacobian) const {
    jacobian.setZero(values(), inputs());
    const Eigen::MatrixXd s = body_.inertia(parameters), a = body_.mobility(s);
    for (int row = 1; row < m_; ++row)
      for (int column = 0; column <= row; ++column) {
        Eigen::MatrixXd ds = Eigen::MatrixXd::Zero(m_, m_);
        ds(row, column) = ds(column, row) = row == column ? s(row, row) : 1.0;
        whiten(body_.rows(body_.mobility(ds), parameters), jacobian.col(RigidBody::bodyAt(row, column)));
      }
    Eigen::MatrixXd slope(n_, 2 * n_);
    for (int kind = 0; kind < RigidBody::kNumKinds; ++kind) {
      for (int j = 0; j < n_; ++j) {
        slope.setZero();
        slope.col(kind * n_ + j) = a.col(j);
        whiten(slope, jacobian.col(body_.firstStrut(kind) + j));
      }
      for (int p = 0; p < body_.numBars(kind); ++p) {
        const auto [i, j] = body_.pairs[p];
        slope.setZero();
        slope.col(kind * n_ + i) = a.col(i) - a.col(j);
        slope.col(kind * n_ + j) = a.col(j) - a.col(i);
        whiten(slope, jacobian.col(body_.firstBar(kind) + p));
      }
    }
    for (int d = 1; d < m_; ++d) jacobian(2 * n_ * n_ + d - 1, RigidBody::bodyAt(d, d)) = 1.0 / kLogInertiaStddev;
    return 0;
  }

  // The struts as if the body's centre of gravity were in their middle and its radii of gyration theirs.
  Eigen::VectorXd start(const BodyRows& rows) const {
    Eigen::VectorXd parameters = Eigen::VectorXd::Zero(inputs());
    const Eigen::VectorXd mobility = body_.mobility(body_.inertia(parameters)).diagonal();
    parameters.segment(body_.firstStrut(RigidBody::kDamping), n_) = rows.rate.diagonal().cwiseQuotient(mobility);
    parameters.segment(body_.firstStrut(RigidBody::kStiffness), n_) = rows.travel.diagonal().cwiseQuotient(mobility);
    return parameters;
  }

 private:
  void whiten(const Eigen::MatrixXd& rows, Eigen::Ref<Eigen::VectorXd> into) const {
    for (Eigen::Index i = 0; i < n_; ++i) into.segment(i * 2 * n_, 2 * n_) = whitening_[i] * rows.row(i).transpose();
  }

  const RigidBody& body_;
  Eigen::Index n_;
  int m_;
  double share_;                            // of the rows that are independent
  Eigen::MatrixXd measured_;                // tops by rates and travels
  std::vector<Eigen::MatrixXd> whitening_;  // by top
};

}  // namespace suspension_health_monitor
