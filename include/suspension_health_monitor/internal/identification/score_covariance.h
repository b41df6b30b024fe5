#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/identification/regression_row.h"

namespace suspension_health_monitor {

/// What a row counts in a weighted recursion.
struct RowWeight {
  double weight = 1.0;            ///< w > 0, as many rows of an LS problem
  double smallest_divisor = 0.0;  ///< d if w = 1 / max(|epsilon|, d); 0: w does not depend on the residual
};

/// By how much the estimates of a weighted recursion scatter more, or less, than P says, because the residuals of
/// neighbouring rows are correlated: each reading of a sensor is in 2 L + 1 rows of the integral filter.
///
/// With weights w_i the estimate's error is R^-1 sum mu^(k-i) s_i, R = sum lambda^(k-i) w_i phi_i phi_i', with scores
/// s_i = w_i e_i phi_i. Hence the sandwich V = R^-1 G R^-1, G the covariance of that sum. It is taken from blocks of
/// B >= 2 L + 1 rows, of which only neighbours share readings: with g_b the block's own discounted sum of scores,
///   G = (A + mu^B (C + C')) / (1 - mu^(2 B)),   A = E[g_b g_b'],   C = E[g_b g_(b-1)'],
/// which is exact whatever the correlation within 2 L rows (method of batch means; for the sandwich see Newey and West,
/// Econometrica 55 (1987)). What is kept is V over what P and the residuals' scale alone would say, parameter by
/// parameter: a change of road or noise acts at once through those, though G is a mean over a long time.
/// - Innovations are whiter than the noise, since the estimate follows correlated noise. So e_i is the residual against
///   a slow course of the best estimate that there is.
/// - LA moves more slowly than lambda says: a row's step is P phi w epsilon, a bounded function of epsilon, which an
///   error of the estimate turns by its mean slope rho / E[w] only. So mu = 1 - (1 - lambda) rho, and the variance is
///   1 / rho times as large. In the scores w is that of e_i.
/// - Rows whose residual or innovation exceeds five mean sizes are wrong readings, or the estimate's way back from
///   them: their scores count as 0. They show in the present scale instead. If most rows are such for longer than a
///   wrong reading lasts, all is learned anew.
/// Cost per row: O(p^2), independent of L, no allocation.
class ScoreCovariance {
 public:
  /// @param num_parameters  p >= 1.
  /// @param correlated_rows  2 L; 0: the residuals are white.
  /// @param forgetting_factor  lambda in (0, 1].
  ScoreCovariance(int num_parameters, int correlated_rows, double forgetting_factor);

  /// Begins with what was known of other parameters: parameter i of the new ones was parameter sources[i], or is new.
  ScoreCovariance(const ScoreCovariance& before, const std::vector<std::optional<int>>& sources);

  /// Learns from a row of an estimate that is worth something.
  /// @param theta  the best estimate before the row, (p).
  /// @param innovation  epsilon of the row, against the estimate that is judged.
  /// @return false if rows have stood out for so long that the parameters or the noise must be others now: what is
  /// known stays, and is learned anew from the rows to come, which should be those of an estimate that has settled.
  bool add(const RegressionRow& row, const Eigen::VectorXd& theta, const RowWeight& weight, double innovation);

  /// The next row does not follow the one before.
  void interrupt();

  /// Forgets what was learned, for a recursion that weighs its rows differently from now on.
  void restart();

  void setForgettingFactor(double forgetting_factor) { forgetting_factor_ = forgetting_factor; }

  /// @param slope  rho in (0, 1], see above.
  void setSlope(double slope) { slope_ = slope; }

  /// @return the size of a residual, limited to what does not stand out, as far as that is known.
  double limited(double size) const;

  /// @return true once what has been seen counts for more than what is assumed beforehand.
  bool isKnown() const;

  /// @return V_ii / (P_ii scale), with the scale E[(w epsilon)^2] / E[w] of the newest rows: what P is multiplied by to
  /// be the variance.
  /// @param weight  sum lambda^(k-i).
  double inflation(int i, double weight) const;

 private:
  /// Sums over rows that do not stand out; of matrices the lower triangle.
  struct Rows {
    Eigen::VectorXd scores;              // g_b
    Eigen::MatrixXd information;         // w phi phi'
    double squares = 0.0, weight = 0.0;  // (w epsilon)^2, w
    int usual = 0, all = 0;              // number of rows
    double decay;                        // mu, the same for all of its rows

    Rows(int num_parameters, double forgetting_factor);
    void clear();
  };

  /// Means over the blocks; lower triangles.
  struct Means {
    Eigen::MatrixXd own, neighbours;    // A, C + C'
    Eigen::MatrixXd information;        // of w phi phi' of a row
    double square = 0.0, weight = 0.0;  // of (w epsilon)^2, w of a row
    double blocks = 0.0;
  };

  /// The block before.
  struct Neighbour {
    Eigen::VectorXd scores;
    bool is_known = false;
  };

  /// Mean size of a residual, and the rows that it rests on.
  struct UsualSize {
    double mean = 0.0, rows = 0.0;
  };

  /// What a step takes its memory from, so that none is allocated.
  struct Workspace {
    Eigen::LLT<Eigen::MatrixXd> factor;
    Eigen::VectorXd column;
  };

  bool isUsual(double residual, double innovation);
  bool closeBlock(const Eigen::VectorXd& theta);
  void limitScores();
  void average(double gain);
  void compareWithWhiteResiduals();
  double longestMemory() const;  // [blocks]

  int block_rows_;
  double forgetting_factor_, slope_ = 1.0;
  UsualSize usual_;
  Eigen::MatrixXd course_;  // (p, 2): mean of the estimate, mean of that mean
  Rows block_;
  Neighbour before_;
  int strange_blocks_ = 0;  // in a row
  Means means_;
  Workspace work_;
  Eigen::VectorXd prior_, ratio_;
};

}  // namespace suspension_health_monitor
