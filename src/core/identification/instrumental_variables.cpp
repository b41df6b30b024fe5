#include "suspension_health_monitor/identification/instrumental_variables.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

// Rounding is about 1e-16 of a correlation, so that a direction just above this is still known to 1e-6.
constexpr double kRankTolerance = 1e-10;

// Below this a square has lost digits to underflow: such a column or row holds nothing any more.
constexpr double kSmallestSquare = 1e-280;

bool saysNothing(const RegressionRow& row, const Eigen::VectorXd& instrument) {
  return row.regressor.isZero(0.0) || instrument.isZero(0.0);
}

double inverseLength(double square) { return square > kSmallestSquare ? 1.0 / std::sqrt(square) : 0.0; }

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
  const auto p = static_cast<int>(rows.regressors.cols());
  if (p < 1 || rows.regressors.rows() < p) return std::nullopt;
  InstrumentalEquations equations(p);
  // Only ratios of weights matter; the largest becomes 1, so that none overflows.
  const double largest = weights.maxCoeff();
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    equations.add(rows.regressors.row(i).transpose(), instruments.row(i).transpose(), rows.outputs[i],
                  weights[i] / largest);
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(p);
  if (equations.solve(theta) < p || !theta.allFinite()) return std::nullopt;
  equations.solve(theta);  // one step of refinement
  return theta;
}

}  // namespace

InstrumentalEquations::InstrumentalEquations(int num_parameters)
    : information_(Eigen::MatrixXd::Zero(num_parameters, num_parameters)),
      right_side_(Eigen::VectorXd::Zero(num_parameters)),
      instrument_squares_(right_side_),
      regressor_squares_(right_side_),
      correlation_(information_),
      row_scale_(right_side_),
      column_scale_(right_side_),
      residual_(right_side_),
      permuted_(right_side_),
      factors_(num_parameters, num_parameters) {
  factors_.setThreshold(kRankTolerance);
}

void InstrumentalEquations::add(const Eigen::Ref<const Eigen::VectorXd>& regressor,
                                const Eigen::Ref<const Eigen::VectorXd>& instrument, double output, double weight) {
  for (Eigen::Index i = 0; i < right_side_.size(); ++i) {
    const double weighted = weight * instrument[i];
    for (Eigen::Index j = 0; j < right_side_.size(); ++j) information_(i, j) += weighted * regressor[j];
    right_side_[i] += weighted * output;
    instrument_squares_[i] += weighted * instrument[i];
    regressor_squares_[i] += weight * regressor[i] * regressor[i];
  }
}

void InstrumentalEquations::scale(double factor) {
  information_ *= factor;
  right_side_ *= factor;
  instrument_squares_ *= factor;
  regressor_squares_ *= factor;
}

int InstrumentalEquations::solve(Eigen::VectorXd& theta) {
  const Eigen::Index p = theta.size();
  row_scale_ = instrument_squares_.unaryExpr(&inverseLength);
  column_scale_ = regressor_squares_.unaryExpr(&inverseLength);
  for (Eigen::Index i = 0; i < p; ++i) {
    residual_[i] = right_side_[i];
    for (Eigen::Index j = 0; j < p; ++j) {
      residual_[i] -= information_(i, j) * theta[j];
      correlation_(i, j) = information_(i, j) * row_scale_[i] * column_scale_[j];
    }
    residual_[i] *= row_scale_[i];
  }
  factors_.compute(correlation_);
  const Eigen::Index rank = factors_.rank();
  for (Eigen::Index i = 0; i < p; ++i) permuted_[factors_.permutationP().indices()[i]] = residual_[i];
  const auto known = Eigen::seqN(0, rank);
  factors_.matrixLU()(known, known).triangularView<Eigen::UnitLower>().solveInPlace(permuted_.head(rank));
  factors_.matrixLU()(known, known).triangularView<Eigen::Upper>().solveInPlace(permuted_.head(rank));
  for (Eigen::Index i = 0; i < rank; ++i) {
    const Eigen::Index j = factors_.permutationQ().indices()[i];
    theta[j] += column_scale_[j] * permuted_[i];
  }
  return static_cast<int>(rank);
}

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

RecursiveInstrumentalEstimator::RecursiveInstrumentalEstimator(int num_parameters, double forgetting_factor)
    : equations_(num_parameters),
      forgetting_factor_(forgetting_factor),
      theta_(Eigen::VectorXd::Zero(num_parameters)),
      absolute_residual_(forgetting_factor) {
  RecursiveOptions options;
  options.forgetting_factor = forgetting_factor;
  options.validate();
}

double RecursiveInstrumentalEstimator::innovate(const RegressionRow& row) {
  const double innovation = residual(row);
  absolute_residual_.add(std::abs(innovation));
  return innovation;
}

void RecursiveInstrumentalEstimator::correct(const RegressionRow& row, const Eigen::VectorXd& instrument,
                                             double weight) {
  equations_.scale(forgetting_factor_);
  equations_.add(row.regressor, instrument, row.output, weight);
  rank_ = equations_.solve(theta_);
}

double RecursiveInstrumentalVariables::update(const RegressionRow& row, const Eigen::VectorXd& instrument) {
  if (saysNothing(row, instrument)) return residual(row);
  const double innovation = innovate(row);
  correct(row, instrument, 1.0);
  return innovation;
}

RecursiveInstrumentalLeastAbsolute::RecursiveInstrumentalLeastAbsolute(int num_parameters, double forgetting_factor,
                                                                       const LeastAbsoluteOptions& options)
    : RecursiveInstrumentalEstimator(num_parameters, forgetting_factor), options_(options) {
  options.validate();
}

double RecursiveInstrumentalLeastAbsolute::update(const RegressionRow& row, const Eigen::VectorXd& instrument) {
  if (saysNothing(row, instrument)) return residual(row);
  const double innovation = innovate(row);
  if (rows_ < options_.start_rows) {
    correct(row, instrument, 1.0);
    // As in RecursiveLeastAbsolute: R of LA sums z phi' / |epsilon|, that of LS z phi'.
    if (++rows_ == options_.start_rows && options_.scale_covariance_at_start && meanAbsoluteResidual() > 0.0)
      equations_.scale(1.0 / meanAbsoluteResidual());
  } else {
    correct(
        row, instrument,
        1.0 / boundedDivisor(innovation, options_.small_divisor_rule, options_.small_divisor, meanAbsoluteResidual()));
  }
  return innovation;
}

}  // namespace suspension_health_monitor
