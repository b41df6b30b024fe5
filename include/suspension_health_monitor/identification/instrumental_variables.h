#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>

#include "suspension_health_monitor/identification/batch_estimators.h"
#include "suspension_health_monitor/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/identification/regression_row.h"
#include "suspension_health_monitor/identification/running_mean.h"

namespace suspension_health_monitor {

/// The equations R theta = r of the instrumental-variable method, R = sum w z phi', r = sum w z psi (p equations).
///
/// The recursion (16) with z in place of phi would carry P = R^-1, which is not symmetric, so that no factored form
/// keeps it sound; and a row with lambda + phi' P z near 0 wrecks it for good. Here R and r themselves are kept: sums
/// of products in which an error fades as the data do, whatever happens. theta comes from a factorisation with complete
/// pivoting of R scaled to correlations, in steps from the last theta: directions in which R says nothing stay put.
/// Cost: O(p^2) to add, O(p^3) to solve, no allocation.
class InstrumentalEquations {
 public:
  /// @param num_parameters  p >= 1.
  explicit InstrumentalEquations(int num_parameters);

  /// @param regressor  phi, (p).  @param instrument  z, (p).  @param weight  w > 0.
  void add(const Eigen::Ref<const Eigen::VectorXd>& regressor, const Eigen::Ref<const Eigen::VectorXd>& instrument,
           double output, double weight);

  /// All rows so far weigh `factor` > 0 times what they did.
  void scale(double factor);

  /// Moves theta, (p), to the solution.
  /// @return number of directions that the rows determine: pivots above 1e-10 of the largest, R scaled by the lengths
  ///         of z_i and phi_j. Below p, as many parameters keep their value.
  int solve(Eigen::VectorXd& theta);

 private:
  Eigen::MatrixXd information_;                             // R
  Eigen::VectorXd right_side_;                              // r
  Eigen::VectorXd instrument_squares_, regressor_squares_;  // sum w z_i^2, sum w phi_j^2
  Eigen::MatrixXd correlation_;
  Eigen::VectorXd row_scale_, column_scale_, residual_, permuted_;
  Eigen::FullPivLU<Eigen::MatrixXd> factors_;
};

/// theta = (sum w z phi')^-1 sum w z psi, w = lambda^(N-i): consistent although phi and e are correlated, provided that
/// z is correlated with phi and not with e. z = phi is least squares.
/// Source: Soederstroem and Stoica (1981); paper, end of sec. 3.1.
/// @param instruments  z, (N, p), in the order of the rows.
/// @return none if the rows do not determine theta.
/// @throws std::invalid_argument  on a wrong forgetting factor or sizes that disagree.
std::optional<Eigen::VectorXd> batchInstrumentalVariables(const RegressionRows& rows,
                                                          const Eigen::MatrixXd& instruments,
                                                          double forgetting_factor = 1.0);

/// The same in the sense of the least sum of absolute values: w = lambda^(N-i) / |e_i|, repeated as in (20)-(23).
/// A fixed point solves sum lambda^(N-i) z_i sgn(e_i) = 0. It is not the minimum of (18), which may therefore rise on
/// the way; iteration ends when (18) changes by less than min_decrease either way.
std::optional<BatchLeastAbsoluteEstimate> batchInstrumentalLeastAbsolute(const RegressionRows& rows,
                                                                         const Eigen::MatrixXd& instruments,
                                                                         const BatchLeastAbsoluteOptions& options = {});

/// What the recursive instrumental estimators have in common.
class RecursiveInstrumentalEstimator {
 public:
  /// @param num_parameters  p >= 1.  @param forgetting_factor  lambda in (0, 1].
  /// @throws std::invalid_argument  naming forgetting_factor, its value and what is allowed.
  RecursiveInstrumentalEstimator(int num_parameters, double forgetting_factor);

  int numParameters() const { return static_cast<int>(theta_.size()); }
  const Eigen::VectorXd& parameters() const { return theta_; }  ///< theta, (p), 0 at the start
  int rank() const { return rank_; }  ///< directions that the rows in memory determine; below p some are held
  double effectiveRows() const { return absolute_residual_.weight(); }       ///< sum of lambda^(k-i)
  double meanAbsoluteResidual() const { return absolute_residual_.mean(); }  ///< running mean of |epsilon|

 protected:
  double residual(const RegressionRow& row) const { return row.output - row.regressor.dot(theta_); }

  /// The residual; also takes it into the running mean.
  double innovate(const RegressionRow& row);
  void correct(const RegressionRow& row, const Eigen::VectorXd& instrument, double weight);

  InstrumentalEquations equations_;

 private:
  double forgetting_factor_;
  Eigen::VectorXd theta_;
  RunningMean absolute_residual_;
  int rank_ = 0;
};

/// Recursive instrumental variables: after each row theta equals batchInstrumentalVariables() over all rows so far.
class RecursiveInstrumentalVariables : public RecursiveInstrumentalEstimator {
 public:
  using RecursiveInstrumentalEstimator::RecursiveInstrumentalEstimator;

  /// @param row  regressor of size p.  @param instrument  z, (p). If either is all zeros, nothing changes.
  /// @return the innovation psi - phi' theta before the update, in the unit of psi.
  double update(const RegressionRow& row, const Eigen::VectorXd& instrument);
};

/// The instrumental form of RecursiveLeastAbsolute: every row is weighted by 1/|epsilon| once, when it comes.
class RecursiveInstrumentalLeastAbsolute : public RecursiveInstrumentalEstimator {
 public:
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  RecursiveInstrumentalLeastAbsolute(int num_parameters, double forgetting_factor, const LeastAbsoluteOptions& options);

  double update(const RegressionRow& row, const Eigen::VectorXd& instrument);

 private:
  LeastAbsoluteOptions options_;
  int rows_ = 0;  // counts up to k0 and stays there
};

}  // namespace suspension_health_monitor
