#pragma once

#include <algorithm>

#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"

namespace suspension_health_monitor {

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
class RecursiveLeastAbsolute : public RecursiveEstimator {
 public:
  using RecursiveEstimator::RecursiveEstimator;

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
