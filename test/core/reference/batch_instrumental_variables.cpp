#include "batch_instrumental_variables.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

// Of correlations, whose rounding is about 1e-16.
constexpr double kRankTolerance = 1e-10;

void requireInstruments(const RegressionRows& rows, const Eigen::MatrixXd& instruments) {
  const Eigen::MatrixXd& phi = rows.regressors;
  if (phi.rows() != rows.outputs.size() || instruments.rows() != phi.rows() || instruments.cols() != phi.cols())
    throw std::invalid_argument("instruments are " + std::to_string(instruments.rows()) + " x " +
                                std::to_string(instruments.cols()) + ", must be as the regressors " +
                                std::to_string(phi.rows()) + " x " + std::to_string(phi.cols()) +
                                ", with as many outputs as rows");
}

std::optional<Eigen::VectorXd> solveWeighted(const RegressionRows& rows, const Eigen::MatrixXd& instruments,
                                             const Eigen::VectorXd& weights) {
  const Eigen::VectorXd root = (weights / weights.maxCoeff()).cwiseSqrt();
  const Eigen::MatrixXd z = root.asDiagonal() * instruments, phi = root.asDiagonal() * rows.regressors;
  const Eigen::VectorXd row_scale = z.colwise().norm().cwiseInverse(), scale = phi.colwise().norm().cwiseInverse();
  Eigen::FullPivLU<Eigen::MatrixXd> factors;
  factors.setThreshold(kRankTolerance);
  factors.compute(row_scale.asDiagonal() * (z.transpose() * phi) * scale.asDiagonal());
  if (!factors.isInvertible()) return std::nullopt;
  const Eigen::VectorXd right_side = row_scale.asDiagonal() * (z.transpose() * root.cwiseProduct(rows.outputs));
  return Eigen::VectorXd(scale.cwiseProduct(factors.solve(right_side)));
}

}  // namespace

std::optional<Eigen::VectorXd> batchInstrumentalVariables(const RegressionRows& rows,
                                                          const Eigen::MatrixXd& instruments,
                                                          double forgetting_factor) {
  requireInstruments(rows, instruments);
  return solveWeighted(rows, instruments, forgettingWeights(rows.outputs.size(), forgetting_factor));
}

std::optional<BatchLeastAbsoluteEstimate> batchInstrumentalLeastAbsolute(const RegressionRows& rows,
                                                                         const Eigen::MatrixXd& instruments,
                                                                         const BatchLeastAbsoluteOptions& options) {
  options.validate();
  requireInstruments(rows, instruments);
  const Eigen::VectorXd weights = forgettingWeights(rows.outputs.size(), options.forgetting_factor);
  std::optional<Eigen::VectorXd> theta = solveWeighted(rows, instruments, weights);
  if (!theta) return std::nullopt;
  BatchLeastAbsoluteEstimate result{*theta, leastAbsoluteCriterion(rows, weights, *theta), 0, false};
  while (!result.converged && result.iterations < options.max_iterations) {
    ++result.iterations;
    theta = solveWeighted(rows, instruments, leastAbsoluteWeights(rows, weights, result.parameters, options));
    if (!theta) break;
    const double criterion = leastAbsoluteCriterion(rows, weights, *theta);
    result.converged = !(std::abs(criterion - result.criterion) >= options.stoppingThreshold(result.criterion));
    result.parameters = *theta;
    result.criterion = criterion;
  }
  return result;
}

}  // namespace suspension_health_monitor
