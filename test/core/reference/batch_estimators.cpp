#include "batch_estimators.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

// Columns have length 1 when this is applied; rounding over 1e6 rows leaves about 1e-15 of it.
constexpr double kRankTolerance = 1e-12;

void requireSizes(const RegressionRows& rows, const Eigen::VectorXd& weights) {
  if (rows.regressors.rows() != rows.outputs.size() || rows.outputs.size() != weights.size())
    throw std::invalid_argument("regressors, outputs and weights have " + std::to_string(rows.regressors.rows()) +
                                ", " + std::to_string(rows.outputs.size()) + " and " + std::to_string(weights.size()) +
                                " rows, must be equally many");
}

void requireForgetting(double forgetting_factor) {
  if (!(forgetting_factor > 0.0 && forgetting_factor <= 1.0))
    throw std::invalid_argument("forgetting_factor = " + std::to_string(forgetting_factor) + ", must be in (0, 1]");
}

void requireNotNegative(const char* name, double value) {
  if (!(std::isfinite(value) && value >= 0.0))
    throw std::invalid_argument(std::string(name) + " = " + std::to_string(value) + ", must be at least 0");
}

Eigen::VectorXd residuals(const RegressionRows& rows, const Eigen::VectorXd& theta) {
  return rows.outputs - rows.regressors * theta;
}

}  // namespace

Eigen::VectorXd forgettingWeights(Eigen::Index num_rows, double forgetting_factor) {
  requireForgetting(forgetting_factor);
  Eigen::VectorXd weights(num_rows);
  double weight = 1.0;
  for (Eigen::Index i = num_rows - 1; i >= 0; --i, weight *= forgetting_factor) weights[i] = weight;
  return weights;
}

std::optional<Eigen::VectorXd> batchLeastSquares(const RegressionRows& rows, const Eigen::VectorXd& weights) {
  requireSizes(rows, weights);
  const Eigen::Index p = rows.regressors.cols();
  if (p < 1 || rows.regressors.rows() < p) return std::nullopt;
  // Only ratios of weights matter; the largest becomes 1, so that none overflows.
  const Eigen::VectorXd root = (weights / weights.maxCoeff()).cwiseSqrt();
  Eigen::MatrixXd scaled = root.asDiagonal() * rows.regressors;
  const Eigen::VectorXd output = root.cwiseProduct(rows.outputs);
  const Eigen::VectorXd lengths = scaled.colwise().stableNorm();
  if (!lengths.allFinite() || !output.allFinite() || !(lengths.minCoeff() > 0.0)) return std::nullopt;
  for (Eigen::Index j = 0; j < p; ++j) scaled.col(j) /= lengths[j];
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(p, p);
  qr.setThreshold(kRankTolerance);
  qr.compute(scaled);
  if (qr.rank() < p) return std::nullopt;
  const Eigen::VectorXd theta = qr.solve(output);
  return Eigen::VectorXd(theta.cwiseQuotient(lengths));
}

std::optional<Eigen::VectorXd> batchLeastSquares(const RegressionRows& rows, double forgetting_factor) {
  return batchLeastSquares(rows, forgettingWeights(rows.outputs.size(), forgetting_factor));
}

void BatchLeastAbsoluteOptions::validate() const {
  requireForgetting(forgetting_factor);
  requireNotNegative("la/min_decrease", min_decrease);
  requireNotNegative("la/small_divisor", small_divisor);
  if (max_iterations < 1)
    throw std::invalid_argument("la/max_iterations = " + std::to_string(max_iterations) + ", must be at least 1");
}

double BatchLeastAbsoluteOptions::stoppingThreshold(double criterion) const {
  return stopping_rule == StoppingRule::kRelative ? min_decrease * criterion : min_decrease;
}

double boundedDivisor(double residual, SmallDivisor rule, double smallest, double residual_scale) {
  return std::max(std::abs(residual), smallestDivisor(rule, smallest, residual_scale));
}

double leastAbsoluteCriterion(const RegressionRows& rows, const Eigen::VectorXd& weights,
                              const Eigen::VectorXd& theta) {
  requireSizes(rows, weights);
  return weights.dot(residuals(rows, theta).cwiseAbs());
}

Eigen::VectorXd leastAbsoluteWeights(const RegressionRows& rows, const Eigen::VectorXd& weights,
                                     const Eigen::VectorXd& theta, const BatchLeastAbsoluteOptions& options) {
  const Eigen::VectorXd residual = residuals(rows, theta);
  const double scale = weights.dot(residual.cwiseAbs()) / weights.sum();
  Eigen::VectorXd result(weights.size());
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    result[i] = weights[i] / boundedDivisor(residual[i], options.small_divisor_rule, options.small_divisor, scale);
  return result;
}

std::optional<BatchLeastAbsoluteEstimate> batchLeastAbsolute(const RegressionRows& rows,
                                                             const BatchLeastAbsoluteOptions& options) {
  options.validate();
  const Eigen::VectorXd weights = forgettingWeights(rows.outputs.size(), options.forgetting_factor);
  const std::optional<Eigen::VectorXd> start = batchLeastSquares(rows, weights);
  if (!start) return std::nullopt;
  BatchLeastAbsoluteEstimate result{*start, leastAbsoluteCriterion(rows, weights, *start), 0, false};
  while (!result.converged && result.iterations < options.max_iterations) {
    ++result.iterations;
    const std::optional<Eigen::VectorXd> next =
        batchLeastSquares(rows, leastAbsoluteWeights(rows, weights, result.parameters, options));
    const double criterion = next ? leastAbsoluteCriterion(rows, weights, *next) : result.criterion;
    const double decrease = result.criterion - criterion;
    result.converged = !(decrease > 0.0 && decrease >= options.stoppingThreshold(result.criterion));
    if (decrease > 0.0) {
      result.parameters = *next;
      result.criterion = criterion;
    }
  }
  return result;
}

}  // namespace suspension_health_monitor
