#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/identification/recursive_covariance.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"

namespace suspension_health_monitor {

UdCovariance::UdCovariance(int size)
    : upper_(Eigen::MatrixXd::Identity(size, size)),
      diagonal_(Eigen::VectorXd::Zero(size)),
      ceiling_(Eigen::VectorXd::Zero(size)),
      gain_(Eigen::VectorXd::Zero(size)) {}

// The kept rows W of U make P = W D W', which has to become triangular again: modified weighted Gram-Schmidt, Bierman,
// ch. VI.4.
UdCovariance::UdCovariance(const UdCovariance& before, const std::vector<ColumnOrigin>& columns)
    : UdCovariance(static_cast<int>(columns.size())) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(size(), before.size());
  for (int i = 0; i < size(); ++i)
    if (const std::optional<int>& source = columns[i].before) {
      rows.row(i) = before.upper_.row(*source);
      ceiling_[i] = before.ceiling_[*source];
    }
  for (int j = size() - 1; j >= 0; --j) {
    const Eigen::VectorXd weighted = before.diagonal_.cwiseProduct(rows.row(j).transpose());
    diagonal_[j] = rows.row(j).dot(weighted);
    if (diagonal_[j] == 0.0) continue;
    for (int i = 0; i < j; ++i) {
      upper_(i, j) = rows.row(i).dot(weighted) / diagonal_[j];
      rows.row(i) -= upper_(i, j) * rows.row(j);
    }
  }
}

const Eigen::VectorXd& UdCovariance::update(const Eigen::VectorXd& regressor, double noise, double forgetting_factor) {
  double alpha = noise;
  for (Eigen::Index j = 0; j < diagonal_.size(); ++j) {
    auto column = upper_.col(j);
    const double f = regressor[j] + column.head(j).dot(regressor.head(j));  // entry j of U' phi
    const double v = diagonal_[j] * f, alpha_before = alpha;
    alpha += f * v;
    diagonal_[j] = std::min(diagonal_[j] * alpha_before / (alpha * forgetting_factor), ceiling_[j]);
    gain_[j] = v;
    for (Eigen::Index i = 0; i < j; ++i) {
      const double before = column[i];
      column[i] -= f / alpha_before * gain_[i];
      gain_[i] += before * v;
    }
  }
  gain_ /= alpha;
  return gain_;
}

Eigen::MatrixXd UdCovariance::matrix() const { return upper_ * diagonal_.asDiagonal() * upper_.transpose(); }

BatchScatter::BatchScatter(const BatchScatter& before, const std::vector<ColumnOrigin>& columns)
    : BatchScatter(static_cast<int>(columns.size()), before.correlated_rows_) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].before) ratios_[i] = before.ratios_[*columns[i].before];
}

void BatchScatter::add(const Eigen::VectorXd& gain, double innovation) {
  if (correlated_rows_ == 0 || ++rows_ <= 0) return;  // the first batch leads from the start values to the strut
  sum_ += innovation * gain;
  squares_ += (innovation * gain).cwiseAbs2();
  if (rows_ < batch_rows_) return;
  for (Eigen::Index i = 0; i < sum_.size(); ++i)
    if (squares_[i] > 0.0) ratios_[i].add(sum_[i] * sum_[i] / squares_[i]);
  interrupt();
}

double BatchScatter::inflation(int i) const {
  if (correlated_rows_ == 0) return 1.0;
  const RunningMean& ratio = ratios_[i];
  const double n = ratio.weight();
  // Batches cut off a part of a correlation that falls linearly: g^2 lacks 1 / (3 kCorrelationsPerBatch) of it.
  const double kept = 1.0 - 1.0 / (3.0 * kCorrelationsPerBatch);
  return n < kFewestBatches ? correlated_rows_ + 1.0 : std::max(1.0, ratio.mean() / kept * n / (n - 2.0));
}

RecursiveLeastSquares::RecursiveLeastSquares(int num_parameters, const RecursiveOptions& options)
    : options_(options),
      theta_(Eigen::VectorXd::Zero(num_parameters)),
      covariance_(num_parameters),
      scatter_(num_parameters, std::max(0, options.correlated_rows)),
      means_(options.forgetting_factor) {
  requireAboveZero("forgetting_factor", options.forgetting_factor, "", 1.0);
  requireAboveZero("initial_variance", options.initial_variance, "");
  if (options.correlated_rows < 0) refuse("correlated_rows", options.correlated_rows, "", "at least 0");
}

double RecursiveLeastSquares::observe(const RegressionRow& row) {
  const double innovation = row.output - row.regressor.dot(theta_);
  means_.add({std::abs(innovation), innovation * innovation, std::abs(row.output)});
  return innovation;
}

void RecursiveLeastSquares::correct(const RegressionRow& row, double innovation, double weight) {
  const double lambda = options_.forgetting_factor;
  const Eigen::VectorXd& gain = covariance_.update(row.regressor, lambda / weight, lambda);
  scatter_.add(gain, innovation);
  theta_ += gain * innovation;
}

void RecursiveLeastSquares::releaseExcited(const RegressionRow& row, double residual_variance, double unit) {
  const Eigen::VectorXd& regressor = row.regressor;
  for (int i = 0; i < numParameters(); ++i) {
    if (covariance_.isReleased(i) || regressor[i] == 0.0) continue;
    const bool relative = options_.initial_variance_rule == InitialVariance::kRelative;
    if (theta_[i] != 0.0 && residual_variance > 0.0)
      covariance_.release(i, theta_[i] * theta_[i] / residual_variance);
    else
      covariance_.release(i, unit * options_.initial_variance / (relative ? regressor[i] * regressor[i] : 1.0));
  }
}

void RecursiveLeastSquares::changeColumns(const std::vector<ColumnOrigin>& columns) {
  const Eigen::VectorXd before = theta_;
  theta_.resize(columns.size());
  for (int i = 0; i < numParameters(); ++i)
    theta_[i] = columns[i].before ? before[*columns[i].before] : columns[i].start;
  covariance_ = UdCovariance(covariance_, columns);
  scatter_ = BatchScatter(scatter_, columns);
}

double RecursiveLeastSquares::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  drift();
  const double innovation = observe(row);
  releaseExcited(row, meanSquareResidual(), 1.0);
  correct(row, innovation, 1.0);
  return innovation;
}

double RecursiveLeastAbsolute::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  if (!leads()) {
    const double innovation = RecursiveLeastSquares::update(row);
    weigh(innovation);
    if (++rows_ == options_.start_rows) takeOver();
    return innovation;
  }
  drift();
  const double innovation = observe(row);
  const double weight = weigh(innovation);
  releaseExcited(row, meanAbsoluteResidual(), options_.scale_covariance_at_start ? meanAbsoluteResidual() : 1.0);
  correct(row, innovation, weight);
  return innovation;
}

double RecursiveLeastAbsolute::weigh(double innovation) {
  const double smallest = smallestDivisor(options_.small_divisor_rule, options_.small_divisor, meanAbsoluteResidual());
  const double weight = 1.0 / std::max(std::abs(innovation), smallest);
  if (!std::isfinite(weight)) return weight;
  const double score = weight * innovation;
  weights_.setForgettingFactor(forgettingFactor());
  weights_.add({score * score, weight});
  return weight;
}

void RecursiveLeastAbsolute::beginAgain(const RecursiveLeastSquares& least_squares) {
  static_cast<RecursiveLeastSquares&>(*this) = least_squares;
  weights_ = RunningMeans<kNumMeans>(forgettingFactor());
  rows_ = options_.start_rows;
  takeOver();
}

void RecursiveLeastAbsolute::takeOver() {
  // R(k) of LA sums phi phi' / |epsilon|, that of LS phi phi': without the factor the start depends on the unit of psi.
  if (options_.scale_covariance_at_start && meanAbsoluteResidual() > 0.0) covariance_.scale(meanAbsoluteResidual());
  scatter_.interrupt();  // rows are weighted from now on
}

}  // namespace suspension_health_monitor
