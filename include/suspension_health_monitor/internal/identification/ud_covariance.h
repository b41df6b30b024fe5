#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

namespace suspension_health_monitor {

/// The covariance P of the recursions (16) and (25), held as P = U D U' with U unit upper triangular and D diagonal.
/// In this form P is symmetric by construction, and stays positive because the update only multiplies D by positive
/// numbers; the textbook form (16) loses both to rounding.
///
/// Source: G. J. Bierman, Factorization Methods for Discrete Sequential Estimation (1977), ch. V.3.
/// Cost per update: O(p^2), no allocation.
class UdCovariance {
 public:
  /// P = 0: no parameter may move until it is given a variance.
  /// @param size  p >= 1, number of parameters.
  explicit UdCovariance(int size);

  /// P of other parameters: parameter i of the new ones is parameter sources[i] of `before`, or one that is fixed
  /// still.
  UdCovariance(const UdCovariance& before, const std::vector<std::optional<int>>& sources);

  int size() const { return static_cast<int>(diagonal_.size()); }

  /// Gives parameter i, so far fixed (all its entries of P are 0), the variance `variance` > 0.
  /// It is also the ceiling of D_i: forgetting never makes a parameter less certain than it was at its start, so that
  /// hours without excitation cannot overflow.
  void release(int i, double variance);

  bool isReleased(int i) const { return ceiling_[i] > 0.0; }

  /// One row with regressor phi:
  ///   P <- (P - P phi phi' P / alpha) / lambda,   alpha = noise + phi' P phi.
  /// @param noise  weight of the prior against the row: lambda in (16), lambda |epsilon| in (25); > 0.
  /// @param forgetting_factor  lambda in (0, 1].
  /// @return the gain P phi / alpha (P before the update), valid until the next call.
  const Eigen::VectorXd& update(const Eigen::VectorXd& regressor, double noise, double forgetting_factor);

  /// What P is once parameter i is the sum of itself and parameter j: P <- F P F', F = I + e_i e_j'. Parameter i counts
  /// before j.
  void addTo(int i, int j) { upper_.row(i) += upper_.row(j); }

  /// P <- factor P, the ceilings with it; factor > 0.
  void scale(double factor);

  /// @return P_ii.
  double variance(int i) const { return entry(i, i); }

  /// @return P_ij.
  double entry(int i, int j) const {
    double sum = 0.0;
    for (Eigen::Index k = std::max(i, j); k < diagonal_.size(); ++k) sum += upper_(i, k) * upper_(j, k) * diagonal_[k];
    return sum;
  }

  /// @return P, (p, p).
  Eigen::MatrixXd matrix() const;

 private:
  Eigen::MatrixXd upper_;     // U, unit diagonal
  Eigen::VectorXd diagonal_;  // D
  Eigen::VectorXd ceiling_;
  Eigen::VectorXd gain_;
};

}  // namespace suspension_health_monitor
