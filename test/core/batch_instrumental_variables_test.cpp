#include "reference/batch_instrumental_variables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "paper_drive.h"
#include "random_rows.h"

namespace suspension_health_monitor {
namespace {

const Eigen::VectorXd kTheta = vectorOf({2.0, -1.0, 0.5});

// Errors in variables: psi = x' theta + noise is seen with phi = x + error; z = 0.5 x + error of its own.
struct InstrumentedRows {
  RegressionRows rows;
  Eigen::MatrixXd instruments;
};

InstrumentedRows errorsInVariables(int count, unsigned seed) {
  InstrumentedRows result{stack(randomRows(kTheta, count, 0.1, seed)), {}};
  std::mt19937_64 engine(seed + 1000);
  std::normal_distribution<double> normal(0.0, 0.5);
  result.instruments = 0.5 * result.rows.regressors;
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < kTheta.size(); ++j) {
      result.rows.regressors(i, j) += normal(engine);
      result.instruments(i, j) += normal(engine);
    }
  return result;
}

TEST(BatchInstrumentalVariables, AreLeastSquaresWhenTheRegressorIsItsOwnInstrument) {
  const RegressionRows rows = stack(randomRows(kTheta, 200, 0.3, 1));
  for (const double lambda : {1.0, 0.95}) {
    const Eigen::VectorXd expected = batchLeastSquares(rows, lambda).value();
    EXPECT_LT((batchInstrumentalVariables(rows, rows.regressors, lambda).value() - expected).norm(), 1e-12);
  }
}

TEST(BatchInstrumentalVariables, SolveTheirDefiningEquations) {
  const InstrumentedRows data = errorsInVariables(300, 2);
  const Eigen::VectorXd theta = batchInstrumentalVariables(data.rows, data.instruments, 0.97).value();
  const Eigen::VectorXd residual = data.rows.outputs - data.rows.regressors * theta;
  const Eigen::VectorXd weights = forgettingWeights(300, 0.97);
  EXPECT_LT((data.instruments.transpose() * weights.cwiseProduct(residual)).norm(), 1e-10);
}

// LS shrinks by 1 / (1 + 0.5^2) = 0.8. IV is consistent: per parameter a standard deviation of
// sigma_e sd(z) / (N cov(z, x)) sqrt(N) = sqrt(0.01 + 0.25 |theta|^2) 0.71 / (0.5 sqrt(N)).
TEST(BatchInstrumentalVariables, AreConsistentWhereLeastSquaresIsNot) {
  const int count = 20'000;
  const InstrumentedRows data = errorsInVariables(count, 3);
  const double deviation = std::sqrt(0.01 + 0.25 * kTheta.squaredNorm()) * 0.71 / (0.5 * std::sqrt(count));
  EXPECT_LT((batchLeastSquares(data.rows).value() - 0.8 * kTheta).norm(), 0.05);
  EXPECT_LT((batchInstrumentalVariables(data.rows, data.instruments).value() - kTheta).cwiseAbs().maxCoeff(),
            5.0 * deviation);
}

TEST(BatchInstrumentalVariables, DoNotDependOnUnits) {
  InstrumentedRows data = errorsInVariables(100, 4);
  const Eigen::VectorXd theta = batchInstrumentalVariables(data.rows, data.instruments).value();
  const Eigen::VectorXd units = vectorOf({1e-9, 1.0, 1e12});
  data.rows.regressors = data.rows.regressors * units.asDiagonal();
  data.instruments = data.instruments * units.reverse().asDiagonal();
  const Eigen::VectorXd scaled = batchInstrumentalVariables(data.rows, data.instruments).value();
  EXPECT_LT((scaled.cwiseProduct(units) - theta).norm(), 1e-10);
}

TEST(BatchInstrumentalVariables, SayNothingWhereTheInstrumentsDoNotDetermineTheParameters) {
  InstrumentedRows data = errorsInVariables(100, 5);
  data.instruments.col(1) = data.instruments.col(0);
  EXPECT_FALSE(batchInstrumentalVariables(data.rows, data.instruments).has_value());
  EXPECT_FALSE(batchInstrumentalLeastAbsolute(data.rows, data.instruments).has_value());
  data.instruments.conservativeResize(99, 3);
  EXPECT_THROW(batchInstrumentalVariables(data.rows, data.instruments), std::invalid_argument);
}

TEST(BatchInstrumentalLeastAbsolute, IsLeastAbsoluteWhenTheRegressorIsItsOwnInstrument) {
  const RegressionRows rows = stack(randomRows(kTheta, 200, 0.3, 6));
  const auto expected = batchLeastAbsolute(rows);
  const auto actual = batchInstrumentalLeastAbsolute(rows, rows.regressors);
  EXPECT_TRUE(actual->converged);
  EXPECT_NEAR(actual->criterion, expected->criterion, 1e-6 * expected->criterion);
  EXPECT_LT((actual->parameters - expected->parameters).norm(), 1e-3);
}

TEST(BatchInstrumentalLeastAbsolute, IsConsistentAndShrugsOffOutliers) {
  InstrumentedRows data = errorsInVariables(5000, 7);
  for (Eigen::Index i = 0; i < 5000; i += 10) data.rows.outputs[i] += 200.0;
  BatchLeastAbsoluteOptions options;
  options.small_divisor = 1e-3;
  const auto estimate = batchInstrumentalLeastAbsolute(data.rows, data.instruments, options);
  EXPECT_TRUE(estimate->converged);
  EXPECT_LT((estimate->parameters - kTheta).norm(), 0.15);
  EXPECT_GT((batchLeastSquares(data.rows).value() - kTheta).norm(), 0.4);
}

}  // namespace
}  // namespace suspension_health_monitor
