#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "suspension_health_monitor/internal/identification/recursive_covariance.h"
#include "suspension_health_monitor/internal/identification/regression.h"
#include "suspension_health_monitor/internal/math/running_means.h"

namespace suspension_health_monitor {

/// Start-up value of the covariance P(0).
enum class InitialVariance {
  kAbsolute,  ///< P_ii(0) = v, the paper's diag(1e5, ...): depends on the units of the data
  kRelative,  ///< P_ii(0) = v / phi_i^2 with the first regressor entry that is not 0: scale-free
};

/// What keeps the weight 1/|epsilon| finite when a row is hit (almost) exactly.
enum class SmallDivisor {
  kAbsolute,  ///< |epsilon| >= eps_min in the unit of psi, as in the paper (below Eq. (23))
  kRelative,  ///< |epsilon| >= eps_min times the scale of the residuals: scale-free
};

struct RecursiveOptions {
  double forgetting_factor = 0.98;  ///< lambda in (0, 1]; memory 1 / (1 - lambda) rows
  double initial_variance = 1e5;    ///< v > 0, [1/phi^2] if absolute, [-] if relative
  InitialVariance initial_variance_rule = InitialVariance::kRelative;
  int correlated_rows = 0;  ///< up to how many rows apart residuals are correlated, >= 0; 0: they are white
  /// The last two parameters are those of an offset o that drifts: c_o = -b0 o, with o at the newest row, and by how
  /// much c_o grows per row.
  bool drifting_offset = false;

  // Of RecursiveLeastAbsolute alone:
  int start_rows = 150;  ///< k0: rows during which LS leads, >= 1
  SmallDivisor small_divisor_rule = SmallDivisor::kRelative;
  double small_divisor = 0.2;             ///< eps_min >= 0, [unit of psi] if absolute, [-] if relative
  bool scale_covariance_at_start = true;  ///< P_LA = P_LS mean|epsilon| at the hand-over, else P_LA = P_LS (paper)
};

/// Recursive least squares with exponential forgetting: minimises sum_i lambda^(k-i) (psi_i - phi_i' theta)^2 (13).
///
/// Source: Eq. (15)-(17), the covariance in factored form (UdCovariance).
/// Assumes: residuals of zero mean and without outliers (else RecursiveLeastAbsolute), not correlated with the
/// regressor (else instrumental variables).
/// A parameter whose regressor entry has been 0 ever since stays at its start, 0 unless changeColumns() said otherwise.
/// Cost per update: O(p^2), no allocation.
///
/// Another estimator that weights rows derives from it as RecursiveLeastAbsolute does, and hides two functions, which
/// are not virtual: they are on the sample path, where the type is known.
///     double update(const RegressionRow& row);      // saysNothing(), drift(), observe(), releaseExcited(), correct()
///     double parameterVariance(int i) const;        // varianceAt()
class RecursiveLeastSquares {
 public:
  /// @param num_parameters  p >= 1.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  RecursiveLeastSquares(int num_parameters, const RecursiveOptions& options);

  /// @param row  regressor of size p. A row of zeros says nothing and changes nothing.
  /// @return the innovation psi - phi' theta before the update, in the unit of psi.
  double update(const RegressionRow& row);

  /// @return variance of theta_i: mean(epsilon^2) P_ii times the scatter of batches.
  double parameterVariance(int i) const { return varianceAt(i, meanSquareResidual()); }

  /// Goes on with other columns: estimates and covariance of those that stay are kept. A new one stays at its start
  /// until a regressor of it is not 0. Then its standard deviation is as large as the start itself, or, from 0 on, what
  /// the initial variance says, in either case free of units. Allocates.
  void changeColumns(const std::vector<ColumnOrigin>& columns);

  int numParameters() const { return static_cast<int>(theta_.size()); }
  const Eigen::VectorXd& parameters() const { return theta_; }  ///< theta, (p)
  const UdCovariance& covariance() const { return covariance_; }
  double forgettingFactor() const { return options_.forgetting_factor; }  ///< the present one

  /// Forgets faster or more slowly from the next row on; the estimate stays.
  void setForgettingFactor(double forgetting_factor) {
    options_.forgetting_factor = forgetting_factor;
    means_.setForgettingFactor(forgetting_factor);
  }

  /// The next row does not follow the one before: residuals of both are not correlated.
  void interrupt() { scatter_.interrupt(); }

  /// Takes a row into the running means only: neither does the estimate move nor is anything forgotten.
  /// @return the innovation epsilon = psi - phi' theta, Eq. (15) and (24), in the unit of psi.
  double observe(const RegressionRow& row);

  /// @return sum of lambda^(k-i): the number of rows that the estimate rests on.
  double effectiveRows() const { return means_.weight(); }

  double meanAbsoluteResidual() const { return means_.mean(kAbsoluteResidual); }  ///< running mean of |epsilon|
  double meanSquareResidual() const { return means_.mean(kSquareResidual); }      ///< running mean of epsilon^2
  double meanAbsoluteOutput() const { return means_.mean(kAbsoluteOutput); }      ///< running mean of |psi|

  /// @return 1 - mean|epsilon| / mean|psi| over the memory [-]; 0 as long as nothing has moved.
  double explained() const {
    return meanAbsoluteOutput() > 0.0 ? 1.0 - meanAbsoluteResidual() / meanAbsoluteOutput() : 0.0;
  }

 protected:
  /// To be called before each row that is not only observed: what drifts has moved since the one before.
  void drift() {
    if (!options_.drifting_offset) return;
    const int rate = numParameters() - 1;
    theta_[rate - 1] += theta_[rate];
    covariance_.addTo(rate - 1, rate);
  }

  /// Gives each parameter whose regressor is not 0 for the first time its start variance; before correct().
  /// @param residual_variance  what turns P_ii into the variance of theta_i.
  /// @param unit  factor from the P of LS to that of this estimator: 1, of LA mean |epsilon|.
  void releaseExcited(const RegressionRow& row, double residual_variance, double unit);

  /// theta <- theta + gain epsilon.
  /// @param weight  w: the row counts as w rows do in LS.
  void correct(const RegressionRow& row, double innovation, double weight);

  /// @return variance of theta_i; infinite as long as no residual has shown any noise.
  /// @param scale  what turns P_ii into that of independent rows.
  double varianceAt(int i, double scale) const {
    if (!(scale > 0.0)) return std::numeric_limits<double>::infinity();
    return scale * covariance_.variance(i) * scatter_.inflation(i);
  }

  RecursiveOptions options_;
  Eigen::VectorXd theta_;
  UdCovariance covariance_;
  BatchScatter scatter_;

 private:
  enum Mean : std::size_t { kAbsoluteResidual, kSquareResidual, kAbsoluteOutput, kNumMeans };

  RunningMeans<kNumMeans> means_;
};

/// @param smallest  eps_min >= 0, [unit of psi] if absolute, [-] if relative.
/// @param residual_scale  mean |epsilon| >= 0 [unit of psi], only used by the relative rule.
/// @return what |residual| is at least taken for [unit of psi]; at least 1e-100, so that a row hit exactly under a
///         threshold of 0 has a weight whose square is still a number.
inline double smallestDivisor(SmallDivisor rule, double smallest, double residual_scale) {
  return std::max(rule == SmallDivisor::kRelative ? smallest * residual_scale : smallest, 1e-100);
}

/// Recursive estimation in the sense of the least sum of absolute values, sum_i lambda^(k-i) |psi_i - phi_i' theta|:
/// every row is weighted by 1/|epsilon| once, when it comes.
///
/// Source: Eq. (24)-(26), started from LS after k0 rows (sec. 3.2). With w = max(|epsilon|, eps_min) the correction is
/// P phi epsilon / w, the least squares step for the weight 1/w; it equals (26), P phi sgn(epsilon), wherever
/// |epsilon| >= eps_min, and does not overshoot below.
/// Robust: good rows keep the weight that they earned while their residual was small, so a burst of outliers longer
/// than the memory does not take over; the exact criterion (18) breaks down there.
/// Cost per update: O(p^2), no allocation.
class RecursiveLeastAbsolute : public RecursiveLeastSquares {
 public:
  using RecursiveLeastSquares::RecursiveLeastSquares;

  /// @param row  regressor of size p. A row of zeros says nothing and changes nothing.
  /// @return the innovation before the update, in the unit of psi.
  double update(const RegressionRow& row);

  /// Goes on from the estimate of LS, as after the first k0 rows.
  /// @param least_squares  of the same rows.
  void beginAgain(const RecursiveLeastSquares& least_squares);

  /// @return variance of theta_i: P_ii times the mean square of the bounded scores over the mean weight, which outliers
  /// hardly touch, times the scatter of batches.
  /// During the first k0 rows that of LS.
  double parameterVariance(int i) const { return varianceAt(i, leads() ? scale() : meanSquareResidual()); }

 private:
  double scale() const { return weights_.mean(kSquareScore) / weights_.mean(kWeight); }
  bool leads() const { return rows_ == options_.start_rows; }  // else LS does
  double weigh(double innovation);
  void takeOver();

  enum Mean : std::size_t { kSquareScore, kWeight, kNumMeans };

  RunningMeans<kNumMeans> weights_{options_.forgetting_factor};  // (w epsilon)^2, w
  int rows_ = 0;                                                 // counts up to k0 and stays there
};

}  // namespace suspension_health_monitor
