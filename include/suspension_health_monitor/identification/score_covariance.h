#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "suspension_health_monitor/identification/regression_row.h"

namespace suspension_health_monitor {

/// What a row counts in a weighted recursion.
struct RowWeight {
  double weight = 1.0;            ///< w > 0, as many rows of an LS problem
  double smallest_divisor = 0.0;  ///< d if w = 1 / max(|epsilon|, d); 0: w does not depend on the residual
};

/// By how much the estimates of a weighted recursion scatter more, or less, than P says, because the residuals of
/// neighbouring rows are correlated: each reading of a sensor is in 2 L + 1 rows of the integral filter.
///
/// With weights w_i the estimate is theta + R^-1 sum lambda^(k-i) s_i, R = sum lambda^(k-i) w_i phi_i phi_i', with
/// scores s_i = w_i e_i phi_i, hence the sandwich V = P G P, G = (sum lambda^2i) sum_m mu^|m| E[s_i s_(i-m)'] over the
/// lags |m| <= 2 L, beyond which white sensor noise leaves no correlation (Newey and West, Econometrica 55 (1987), with
/// their kernel cut where this residual's correlation ends). What is kept is its ratio to P, parameter by parameter, so
/// that a change of road or noise acts at once through P and the residuals' scale, though G is a mean over a long time.
/// Two things that the paper's estimators need beside:
/// - Innovations are whiter than the noise, since the estimate follows correlated noise. So e_i is the residual against
///   a slow course of the estimate.
/// - LA moves more slowly than lambda says: a row's step is P phi w epsilon, a bounded function of epsilon, which an
///   error of the estimate turns by its mean slope rho / E[w] only. So mu = 1 - (1 - lambda) rho, and the variance is
///   1/rho times as large; in the scores w is that of e_i.
/// Of LA, rows whose residual or innovation is beyond kFar mean sizes of a residual are left out of the means: readings
/// that are wrong, and rows while the estimate comes back from them. They are so large that their correlation and their
/// scale would be all that is learned, and they need not be in the same rows. What they do to the estimate shows in the
/// present scale. Once it has learned enough it looks at an eighth of the rows, in stretches of 6 L, which is plenty
/// for what changes as slowly as this. Cost per row: O(p^2), independent of L, no allocation.
class ScoreCovariance {
 public:
  /// @param num_parameters  p >= 1.
  /// @param correlated_rows  2 L; 0: the residuals are white.
  /// @param forgetting_factor  lambda in (0, 1].
  ScoreCovariance(int num_parameters, int correlated_rows, double forgetting_factor);

  /// Starts with what was known of other parameters: parameter i of the new ones was parameter sources[i], or is new.
  ScoreCovariance(const ScoreCovariance& before, const std::vector<std::optional<int>>& sources);

  /// Takes in a row.
  /// @param theta  the estimate before it, (p).
  /// @param innovation  epsilon of the row, against theta.
  void add(const RegressionRow& row, const Eigen::VectorXd& theta, const RowWeight& weight, double innovation);

  /// The next row does not follow the one before.
  void interrupt();

  /// @return mean size of a residual over the scale, of rows that do not stand out; 0 or NaN as long as it is not
  /// known.
  double sizePerScale() const { return usual_ * weight_ / square_; }

  /// For a recursion that begins to weigh its rows differently: what was learned does not hold any more.
  /// @param unit  of the inflation from now on, in that of before.
  void restart(double unit);

  /// The estimate is one only now. If much has been learned by then, it was from rows that told nothing, as those of a
  /// vehicle that stands: the slow course, and what was learned against it, are of no use.
  void beginHere();

  void setForgettingFactor(double forgetting_factor);

  /// @param slope  rho in (0, 1], see above.
  void setSlope(double slope) { slope_ = slope; }

  /// @return true at every few rows: often enough to look at what changes slowly.
  bool isNowAndThen() const { return phase_ % kFewRows == 0; }
  bool isEveryFourth() const { return phase_ % 4 == 0; }

  /// @return what correlation alone makes of a variance, as a multiple of that for residuals that are not correlated.
  double correlation(int i) const { return ratio_[i]; }

  /// @return V_ii / (P_ii scale), with the scale E[(w epsilon)^2] / E[w] of the newest rows: what P is multiplied by to
  /// be the variance for residuals that are not correlated.
  /// @param weight  sum lambda^(k-i).
  double inflation(int i, double weight) const {
    const double forgetting = 1.0 - forgetting_factor_;
    // The weight of a memory that was longer still counts for a while.
    return ratio_[i] * (2.0 - std::min(1.0, forgetting * weight)) / (slope_ * (2.0 - forgetting * slope_));
  }

 private:
  static constexpr int kFewRows = 8;  // between looks at what changes slowly

  bool addScore(const RegressionRow& row, double smallest_divisor);
  bool isUsual(double size);
  void endStretch();
  // Out of line: rare, and long enough to take the registers of what comes with every row.
  [[gnu::noinline]] void nowAndThen(const Eigen::VectorXd& theta);
  void follow(const Eigen::VectorXd& theta);
  void average(const double* regressor, double weight, double innovation);
  void refresh();
  void setDecay();

  int size_, lags_;
  double forgetting_factor_;
  double slope_ = 1.0;
  double decay_ = 1.0, end_decay_ = 1.0;  // mu, mu^(2 L + 1)
  double slow_gain_ = 0.0;                // of the means, once they are long enough
  Eigen::VectorXd slow_theta_;            // slow course of the estimate
  Eigen::VectorXd once_, twice_;          // its means, and their means
  Eigen::VectorXd score_, lagged_;        // s_k; sum_{m=1..2L} mu^m s_(k-m)
  std::vector<double> line_;              // the newest 2 L + 1 scores
  std::size_t mask_;
  std::size_t newest_ = 0;
  int first_rows_;                                 // that are still to come, of the start or a restart
  int rest_ = 0;                                   // rows that are not looked at
  int in_stretch_ = 0;                             // rows that have been, without a break
  unsigned phase_ = 0;                             // number of the row, modulo what is done only now and then
  double usual_ = 0.0;                             // size of a residual
  double averaged_ = 0.0;                          // rows in the means below
  Eigen::MatrixXd long_run_, lag0_, information_;  // means of s s' + s c' + c s', s s', w phi phi'
  double square_ = 0.0, weight_ = 0.0;             // means of (w epsilon)^2, w
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd unit_, column_;
  double unknown_;  // ratio of a parameter of which nothing is known
  Eigen::VectorXd prior_, ratio_;
};

}  // namespace suspension_health_monitor
