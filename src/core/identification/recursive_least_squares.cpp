#include "suspension_health_monitor/identification/recursive_least_squares.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {

void RecursiveOptions::validate() const {
  if (!(forgetting_factor > 0.0 && forgetting_factor <= 1.0))
    throw std::invalid_argument("forgetting_factor = " + std::to_string(forgetting_factor) + ", must be in (0, 1]");
  if (!(std::isfinite(initial_variance) && initial_variance > 0.0))
    throw std::invalid_argument("initial_variance = " + std::to_string(initial_variance) + ", must be above 0");
}

RecursiveEstimator::RecursiveEstimator(int num_parameters, const RecursiveOptions& options)
    : options_(options),
      theta_(Eigen::VectorXd::Zero(num_parameters)),
      covariance_(num_parameters),
      means_(options.forgetting_factor) {
  options.validate();
}

double RecursiveEstimator::innovate(const RegressionRow& row) {
  double innovation = row.output;
  const double* const phi = row.regressor.data();
  const double* const theta = theta_.data();
  for (Eigen::Index i = 0, p = theta_.size(); i < p; ++i) innovation -= phi[i] * theta[i];
  means_.add({std::abs(innovation), innovation * innovation, std::abs(row.output)});
  return innovation;
}

void RecursiveEstimator::correct(const RegressionRow& row, double innovation, double weight) {
  if (num_released_ < numParameters()) releaseExcited(row.regressor);
  const double* const gain =
      covariance_.update(row.regressor, options_.forgetting_factor / weight, options_.forgetting_factor).data();
  double* const theta = theta_.data();
  for (Eigen::Index i = 0, p = theta_.size(); i < p; ++i) theta[i] += gain[i] * innovation;
}

void RecursiveEstimator::releaseExcited(const Eigen::VectorXd& regressor) {
  for (int i = 0; i < numParameters(); ++i) {
    if (covariance_.isReleased(i) || regressor[i] == 0.0) continue;
    const bool relative = options_.initial_variance_rule == InitialVariance::kRelative;
    covariance_.release(i, options_.initial_variance / (relative ? regressor[i] * regressor[i] : 1.0));
    ++num_released_;
  }
}

double RecursiveLeastSquares::update(const RegressionRow& row) {
  if (row.saysNothing()) return row.output;
  const double innovation = innovate(row);
  correct(row, innovation, 1.0);
  return innovation;
}

}  // namespace suspension_health_monitor
