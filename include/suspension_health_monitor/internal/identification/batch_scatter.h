#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

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
        ratios_(static_cast<std::size_t>(num_parameters), RunningMean(1.0 - 1.0 / kBatches)) {}

  /// Of other parameters, knowing of those that stay what was known: number i was number sources[i], or is new.
  BatchScatter(const BatchScatter& before, const std::vector<std::optional<int>>& sources)
      : BatchScatter(static_cast<int>(sources.size()), before.correlated_rows_) {
    for (std::size_t i = 0; i < sources.size(); ++i)
      if (sources[i]) ratios_[i] = before.ratios_[static_cast<std::size_t>(*sources[i])];
  }

  /// @param gain  of the row, by parameter.
  void add(const Eigen::VectorXd& gain, double innovation) {
    if (correlated_rows_ == 0 || ++rows_ <= 0) return;  // the first batch leads from the start values to the strut
    sum_ += innovation * gain;
    squares_ += (innovation * gain).cwiseAbs2();
    if (rows_ < batch_rows_) return;
    for (Eigen::Index i = 0; i < sum_.size(); ++i)
      if (squares_[i] > 0.0) ratios_[static_cast<std::size_t>(i)].add(sum_[i] * sum_[i] / squares_[i]);
    interrupt();
  }

  /// The next row does not follow the one before.
  void interrupt() {
    sum_.setZero();
    squares_.setZero();
    rows_ = std::min(rows_, 0);
  }

  /// @return the factor of parameter i; all rows of a filter alike until there are enough batches.
  double inflation(int i) const {
    if (correlated_rows_ == 0) return 1.0;
    const RunningMean& ratio = ratios_[static_cast<std::size_t>(i)];
    const double n = ratio.weight();
    return n < kFewestBatches ? correlated_rows_ + 1.0 : std::max(1.0, kOfEnds * ratio.mean() * n / (n - 2.0));
  }

 private:
  static constexpr int kCorrelationsPerBatch = 4;
  // A correlation that falls in a line is cut at the ends of a batch: a third of one of them is missing in g^2.
  static constexpr double kOfEnds = 1.0 / (1.0 - 1.0 / (3.0 * kCorrelationsPerBatch));
  static constexpr double kFewestBatches = 2.9, kBatches = 30.0;  // three; a mean of n squares varies by sqrt(2 / n)

  int correlated_rows_, batch_rows_;
  int rows_;  // of the batch; below 0: before the first one
  Eigen::VectorXd sum_, squares_;
  std::vector<RunningMean> ratios_;
};

}  // namespace suspension_health_monitor
