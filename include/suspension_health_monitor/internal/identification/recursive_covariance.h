#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/math/running_means.h"

namespace suspension_health_monitor {

/// Where a parameter comes from when the columns of a regression change.
struct ColumnOrigin {
  std::optional<int> before;  ///< its number before the change; none: it is new
  double start = 0.0;         ///< what a new one starts from [unit of the parameter]
};

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

  /// P of other parameters, of which a new one has the variance 0 until release().
  UdCovariance(const UdCovariance& before, const std::vector<ColumnOrigin>& columns);

  int size() const { return static_cast<int>(diagonal_.size()); }

  /// Gives parameter i, so far fixed (all its entries of P are 0), the variance `variance` > 0.
  /// It is also the ceiling of D_i: forgetting never makes a parameter less certain than it was at its start, so that
  /// hours without excitation cannot overflow.
  void release(int i, double variance) { diagonal_[i] = ceiling_[i] = variance; }

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
  void scale(double factor) {
    diagonal_ *= factor;
    ceiling_ *= factor;
  }

  /// @return P_ii.
  double variance(int i) const {
    const int above = size() - i;  // the rest of the row of U is 0
    return upper_.row(i).tail(above).cwiseAbs2().dot(diagonal_.tail(above));
  }

  /// @return P, (p, p).
  Eigen::MatrixXd matrix() const;

 private:
  Eigen::MatrixXd upper_;     // U, unit diagonal
  Eigen::VectorXd diagonal_;  // D
  Eigen::VectorXd ceiling_;
  Eigen::VectorXd gain_;
};

/// By how much the variance of a recursive estimate exceeds the one for independent rows: each reading of a sensor is
/// in 2 L + 1 rows of the integral filter. With d_i the step of the estimate by row i, gain times innovation, and g
/// their sum over a batch of rows much longer than that, it is E[g^2] / sum E[d^2], parameter by parameter (method of
/// batch means, e.g. C. J. Geyer, Practical Markov chain Monte Carlo, 1992). A mean over n batches is known as a
/// variance with n degrees of freedom is: the estimate scatters about it as Student's t, whose variance is n / (n - 2).
/// Cost per row: O(p), no allocation.
class BatchScatter {
 public:
  /// @param num_parameters  p >= 1.  @param correlated_rows  2 L; 0: the rows are independent.
  BatchScatter(int num_parameters, int correlated_rows)
      : correlated_rows_(correlated_rows),
        batch_rows_(kCorrelationsPerBatch * (correlated_rows + 1)),
        rows_(-batch_rows_),
        sum_(Eigen::VectorXd::Zero(num_parameters)),
        squares_(sum_),
        ratios_(num_parameters, RunningMean(1.0 - 1.0 / kBatches)) {}

  /// Of other parameters, knowing of those that stay what was known.
  BatchScatter(const BatchScatter& before, const std::vector<ColumnOrigin>& columns);

  /// @param gain  of the row, by parameter.
  void add(const Eigen::VectorXd& gain, double innovation);

  /// The next row does not follow the one before.
  void interrupt() {
    sum_.setZero();
    squares_.setZero();
    rows_ = std::min(rows_, 0);
  }

  /// @return the factor of parameter i; until three batches are complete as if all rows of a window were equal.
  double inflation(int i) const;

 private:
  static constexpr int kCorrelationsPerBatch = 4;
  static constexpr double kFewestBatches = 2.9;  // three, less rounding
  static constexpr double kBatches = 30.0;       // the factor is then known to sqrt(2 / 30) = 26 %

  int correlated_rows_, batch_rows_;
  int rows_;  // of the batch; below 0: before the first one
  Eigen::VectorXd sum_, squares_;
  std::vector<RunningMean> ratios_;
};

}  // namespace suspension_health_monitor
