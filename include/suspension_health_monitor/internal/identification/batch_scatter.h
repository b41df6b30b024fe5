#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "suspension_health_monitor/internal/identification/regression_row.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// By how much the variance of a recursive estimate exceeds the one for independent rows: each reading of a sensor is
/// in 2 L + 1 rows of the integral filter. With scores s_i = w_i e_i phi_i, and g their sum over a batch of rows much
/// longer than that, it is E[g^2] / sum E[s^2], averaged over the parameters (method of batch means, e.g. C. J. Geyer,
/// Practical Markov chain Monte Carlo, 1992). Cost per row: O(p), no allocation.
class BatchScatter {
 public:
  /// @param num_parameters  p >= 1.  @param correlated_rows  2 L; 0: the rows are independent.
  BatchScatter(int num_parameters, int correlated_rows)
      : correlated_rows_(correlated_rows),
        batch_rows_(kCorrelationsPerBatch * (correlated_rows + 1)),
        sum_(Eigen::VectorXd::Zero(num_parameters)),
        squares_(sum_),
        ratio_(1.0 - 1.0 / kBatches) {}

  /// @param score  w e of the row.
  void add(const RegressionRow& row, double score) {
    if (correlated_rows_ == 0) return;
    sum_ += score * row.regressor;
    squares_ += (score * row.regressor).cwiseAbs2();
    if (++rows_ < batch_rows_) return;
    double ratio = 0.0, count = 0.0;
    for (Eigen::Index i = 0; i < sum_.size(); ++i) {
      if (!(squares_[i] > 0.0)) continue;
      ratio += sum_[i] * sum_[i] / squares_[i];
      count += 1.0;
    }
    if (count > 0.0) ratio_.add(ratio / count);
    interrupt();
  }

  /// The next row does not follow the one before.
  void interrupt() {
    sum_.setZero();
    squares_.setZero();
    rows_ = 0;
  }

  /// @return the factor; all rows of a filter alike until enough batches are known.
  double inflation() const {
    if (correlated_rows_ == 0) return 1.0;
    const double known = std::min(1.0, ratio_.weight() / kFewestBatches);
    return known * std::max(1.0, ratio_.mean()) + (1.0 - known) * (correlated_rows_ + 1.0);
  }

 private:
  static constexpr int kCorrelationsPerBatch = 4;                   // a quarter of a batch is then at its ends
  static constexpr double kFewestBatches = 20.0, kBatches = 100.0;  // a mean of n squares varies by sqrt(2 / n)

  int correlated_rows_, batch_rows_;
  int rows_ = 0;
  Eigen::VectorXd sum_, squares_;
  RunningMean ratio_;
};

}  // namespace suspension_health_monitor
