#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/plain_text.h"

namespace suspension_health_monitor {

void RecursiveOptions::validate() const {
  requireAboveZero("forgetting_factor", forgetting_factor, "", 1.0);
  requireAboveZero("initial_variance", initial_variance, "");
  if (correlated_rows < 0) refuse("correlated_rows", correlated_rows, "", "at least 0");
}

RecursiveEstimator::RecursiveEstimator(int num_parameters, const RecursiveOptions& options)
    : options_(options),
      theta_(Eigen::VectorXd::Zero(num_parameters)),
      covariance_(num_parameters),
      scatter_(num_parameters, std::max(0, options.correlated_rows)),
      means_(options.forgetting_factor) {
  options.validate();
}

double RecursiveEstimator::innovate(const RegressionRow& row) {
  const double innovation = row.output - row.regressor.dot(theta_);
  means_.add({std::abs(innovation), innovation * innovation, std::abs(row.output)});
  return innovation;
}

void RecursiveEstimator::setForgettingFactor(double forgetting_factor) {
  options_.forgetting_factor = forgetting_factor;
  means_.setForgettingFactor(forgetting_factor);
}

void RecursiveEstimator::correct(const RegressionRow& row, double innovation, double weight) {
  const double lambda = options_.forgetting_factor;
  const Eigen::VectorXd& gain = covariance_.update(row.regressor, lambda / weight, lambda);
  scatter_.add(gain, innovation);
  theta_ += gain * innovation;
}

void RecursiveEstimator::release(const Eigen::VectorXd& regressor, double residual_variance, double unit) {
  for (int i = 0; i < numParameters(); ++i) {
    if (covariance_.isReleased(i) || regressor[i] == 0.0) continue;
    const bool relative = options_.initial_variance_rule == InitialVariance::kRelative;
    if (theta_[i] != 0.0 && residual_variance > 0.0)
      covariance_.release(i, theta_[i] * theta_[i] / residual_variance);
    else
      covariance_.release(i, unit * options_.initial_variance / (relative ? regressor[i] * regressor[i] : 1.0));
    ++num_released_;
  }
}

void RecursiveEstimator::changeColumns(const std::vector<ColumnOrigin>& columns) {
  const Eigen::VectorXd before = theta_;
  theta_.resize(static_cast<Eigen::Index>(columns.size()));
  std::vector<std::optional<int>> sources;
  for (const ColumnOrigin& column : columns) {
    theta_[static_cast<Eigen::Index>(sources.size())] = column.before ? before[*column.before] : column.start;
    sources.push_back(column.before);
  }
  covariance_ = UdCovariance(covariance_, sources);
  scatter_ = BatchScatter(scatter_, sources);
  num_released_ = 0;
  for (int i = 0; i < numParameters(); ++i) num_released_ += covariance_.isReleased(i) ? 1 : 0;
}

double RecursiveLeastSquares::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  drift();
  const double innovation = innovate(row);
  releaseExcited(row, meanSquareResidual(), 1.0);
  correct(row, innovation, 1.0);
  return innovation;
}

}  // namespace suspension_health_monitor
