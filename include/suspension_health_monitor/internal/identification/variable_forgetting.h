#pragma once

#include <Eigen/Core>

#include "suspension_health_monitor/internal/identification/regression_row.h"

namespace suspension_health_monitor {

/// A forgetting factor that is slow as long as the parameters stay and fast while they move.
///
/// While an estimate is right its scores, the regressors times a bounded function of the residual, have the mean 0,
/// whatever the road and the noise; when parameter i has moved, scores phi_i b have the sign of what it has moved by.
/// So
///   b = epsilon / m, clamped to [-1, 1];  0 beyond |epsilon| = 5 m;  m the running mean |epsilon|,
///   s_i = mean of b phi_i,  q_i = mean of (b phi_i)^2,  both over M = 3 (2 L + 1) rows (exponential weights),
///   T = max_i s_i^2 / q_i in [0, 1],
///   lambda = slow + (fastest - slow) min(max(T / t - 1, 0), 1),  t = (1 - e^(-1/3))^2 = 0.080.
/// Why t: one wrong reading is in 2 L + 1 rows, a third of the memory; all of one sign they make s_i^2 / q_i = t among
/// rows of full size. By chance, s_i^2 / q_i of scores correlated over c rows has a mean of c / (2 M): c is 0.2 to 2.5
/// at usual horizons, about 0.05 (2 L + 1) at most (doc/forgetting.md), which makes t ten times that. M is at least 60
/// rows for the same reason. A row far off says that a reading is wrong, or that much has changed: then m grows, and
/// soon it counts.
///
/// Source: scores as the statistic of a change are the local approach (Benveniste, Basseville, Moustakides, IEEE Trans.
/// Automatic Control 32 (1987), 583-592) and the M-fluctuation tests (Zeileis, Hornik, Statistica Neerlandica 61
/// (2007), 488-508); b is Huber's, rejecting far rows as Hampel's does. Variable factors usually go by the size of the
/// residuals (Fortescue, Kershenbaum, Ydstie, Automatica 17 (1981), 831-835; by an F-test of it: Mohseni, Bernstein,
/// American Control Conference 2022), which outliers and model errors raise as well. M, t, the rejection and lambda's
/// line are this project's own.
/// Cost per row: O(p), no allocation. Free of the units of data and time.
class VariableForgetting {
 public:
  static constexpr int kDecideEvery = 8;  ///< rows, at which factor() is worth a look

  /// @param num_parameters  p >= 1.  @param correlated_rows  2 L >= 0.
  /// @param slow, fastest  forgetting factors, 0 < fastest <= slow <= 1.
  VariableForgetting(int num_parameters, int correlated_rows, double slow, double fastest);

  /// Other bounds; what has been seen of the rows stays.
  void setFactors(double slow, double fastest);

  /// Knows of no row any more; allocates.
  /// @param num_parameters  p >= 1.
  void restart(int num_parameters);

  /// Takes in a row.
  /// @param innovation  psi - phi' theta before the row, in the unit of psi.
  /// @param mean_residual  running mean of its size, in the unit of psi.
  void add(const RegressionRow& row, double innovation, double mean_residual);

  double slow() const { return slow_; }

  /// @return T: how much of the rows' scores is drift [-].
  double drift() const;

  /// @return lambda in [fastest, slow], for the rows to come.
  double factor() const;

 private:
  double slow_, fastest_;
  double gain_;              // 1 / M
  Eigen::VectorXd scores_;   // s, (p); 0 at the start: nothing is known to move
  Eigen::VectorXd squares_;  // q, (p)
};

}  // namespace suspension_health_monitor
