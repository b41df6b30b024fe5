#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "paper_drive.h"
#include "random_rows.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"

namespace suspension_health_monitor {
namespace {

RecursiveLeastSquares estimate(const std::vector<RegressionRow>& rows, const RecursiveOptions& options) {
  RecursiveLeastSquares estimator(static_cast<int>(rows.front().regressor.size()), options);
  for (const RegressionRow& row : rows) estimator.update(row);
  return estimator;
}

const Eigen::VectorXd kTheta = vectorOf({3.0, -14.0, 0.5});

// Least squares with the start P(0) = v I, theta(0) = 0 counted as what it is, a prior faded by lambda^k.
Eigen::VectorXd batchWithPrior(const std::vector<RegressionRow>& rows, double lambda, double variance) {
  const RegressionRows stacked = stack(rows);
  const Eigen::VectorXd weights = forgettingWeights(stacked.outputs.size(), lambda);
  Eigen::MatrixXd information = stacked.regressors.transpose() * weights.asDiagonal() * stacked.regressors;
  information.diagonal().array() += std::pow(lambda, static_cast<double>(rows.size())) / variance;
  const Eigen::VectorXd right = stacked.regressors.transpose() * weights.asDiagonal() * stacked.outputs;
  return information.partialPivLu().solve(right);
}

TEST(RecursiveLeastSquares, EqualsBatchLeastSquaresWithAndWithoutForgetting) {
  const auto rows = randomRows(kTheta, 400, 0.3, 1);
  for (const double lambda : {1.0, 0.98, 0.9}) {
    const RecursiveOptions options{lambda, 1e5, InitialVariance::kAbsolute};
    EXPECT_LT((estimate(rows, options).parameters() - batchWithPrior(rows, lambda, 1e5)).norm(), 1e-9);
    const RecursiveOptions vague{lambda, 1e12, InitialVariance::kRelative};
    EXPECT_LT((estimate(rows, vague).parameters() - batchLeastSquares(stack(rows), lambda).value()).norm(), 1e-6);
  }
}

TEST(RecursiveLeastSquares, HasTheInverseInformationAsItsCovariance) {
  const auto rows = randomRows(kTheta, 200, 0.3, 2);
  const RegressionRows stacked = stack(rows);
  const Eigen::MatrixXd information =
      stacked.regressors.transpose() * forgettingWeights(200, 0.95).asDiagonal() * stacked.regressors;
  const auto estimator = estimate(rows, {0.95, 1e9, InitialVariance::kAbsolute});
  const Eigen::MatrixXd product = information * estimator.covariance().matrix();
  EXPECT_LT((product - Eigen::MatrixXd::Identity(3, 3)).norm(), 1e-6);
}

TEST(RecursiveLeastSquares, PermutesTheParametersWithTheColumns) {
  const auto rows = randomRows(kTheta, 100, 0.3, 3);
  const int order[] = {2, 0, 1};
  auto permuted = rows;
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (int i = 0; i < 3; ++i) permuted[k].regressor[i] = rows[k].regressor[order[i]];
  const auto expected = estimate(rows, {});
  const auto actual = estimate(permuted, {});
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(actual.parameters()[i], expected.parameters()[order[i]], 1e-10);
    EXPECT_NEAR(actual.covariance().variance(i), expected.covariance().variance(order[i]), 1e-10);
  }
}

TEST(RecursiveLeastSquares, ScalesWithTheUnitsUnderTheRelativeStart) {
  const auto rows = randomRows(kTheta, 300, 0.3, 4);
  const Eigen::VectorXd column_units = vectorOf({1e6, 0.01, 1.0});
  for (const double output_unit : {1e6, 0.01}) {
    auto scaled = rows;
    for (RegressionRow& row : scaled) {
      row.regressor = row.regressor.cwiseProduct(column_units);
      row.output *= output_unit;
    }
    RecursiveLeastSquares expected(3, {}), actual(3, {});
    for (std::size_t k = 0; k < rows.size(); ++k) {
      expected.update(rows[k]);
      actual.update(scaled[k]);
      const Eigen::VectorXd back = actual.parameters().cwiseProduct(column_units) / output_unit;
      EXPECT_LT((back - expected.parameters()).norm(), 1e-9 * expected.parameters().norm()) << "row " << k;
    }
  }
}

TEST(RecursiveLeastSquares, GivesTheStrutTheSameValuesWhateverUnitTheAccelerationsAreIn) {
  const std::vector<CornerSample> drive = healthyPaperDrive(20.0, 0.024);
  for (const double unit : {1e6, 0.01}) {
    auto scaled = drive;
    for (CornerSample& sample : scaled) {
      sample.sprung_acceleration *= unit;
      sample.unsprung_acceleration *= unit;
    }
    const Eigen::VectorXd expected = estimate(strutRows(drive, {}), {}).parameters();
    const Eigen::VectorXd actual = estimate(strutRows(scaled, {}), {}).parameters();
    EXPECT_LT((actual - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(RecursiveLeastSquares, IgnoresARowOfZeros) {
  auto estimator = estimate(randomRows(kTheta, 50, 0.3, 5), {});
  const Eigen::VectorXd theta = estimator.parameters();
  const Eigen::MatrixXd covariance = estimator.covariance().matrix();
  const double rows = estimator.effectiveRows();
  EXPECT_EQ(estimator.update({Eigen::VectorXd::Zero(3), 4.0}), 4.0);
  EXPECT_EQ(estimator.parameters(), theta);
  EXPECT_EQ(estimator.covariance().matrix(), covariance);
  EXPECT_EQ(estimator.effectiveRows(), rows);
}

TEST(RecursiveLeastSquares, LeavesAParameterWithoutExcitationAtZeroUntilItIsExcited) {
  auto rows = randomRows(kTheta, 200, 0.0, 6);
  for (RegressionRow& row : rows) {
    row.output -= row.regressor[1] * kTheta[1];
    row.regressor[1] = 0.0;
  }
  auto estimator = estimate(rows, {});
  EXPECT_EQ(estimator.parameters()[1], 0.0);
  EXPECT_NEAR(estimator.parameters()[0], kTheta[0], 1e-6);
  for (const RegressionRow& row : randomRows(kTheta, 200, 0.0, 7)) estimator.update(row);
  EXPECT_LT((estimator.parameters() - kTheta).norm(), 1e-6);
}

TEST(RecursiveLeastSquares, ReturnsTheInnovationBeforeTheUpdateAndCountsRows) {
  RecursiveLeastSquares estimator(1, {0.5, 1e9, InitialVariance::kAbsolute});
  EXPECT_EQ(estimator.update({vectorOf({2.0}), 6.0}), 6.0);
  EXPECT_NEAR(estimator.parameters()[0], 3.0, 1e-8);
  EXPECT_NEAR(estimator.update({vectorOf({1.0}), 5.0}), 2.0, 1e-8);
  EXPECT_EQ(estimator.effectiveRows(), 1.5);
  EXPECT_NEAR(estimator.meanAbsoluteResidual(), (0.5 * 6.0 + 2.0) / 1.5, 1e-8);
  EXPECT_NEAR(estimator.meanSquareResidual(), (0.5 * 36.0 + 4.0) / 1.5, 1e-7);
  EXPECT_NEAR(estimator.meanAbsoluteOutput(), (0.5 * 6.0 + 5.0) / 1.5, 1e-12);
}

TEST(RecursiveLeastSquares, ExplainedIsWhatTheRowsLeaveOfTheOutput) {
  RecursiveOptions options;
  options.forgetting_factor = 1.0;
  RecursiveLeastSquares estimator(1, options);
  EXPECT_EQ(estimator.explained(), 0.0);
  double residuals = 0.0, outputs = 0.0;
  for (int k = 0; k < 100; ++k) {
    const RegressionRow row{Eigen::VectorXd::Constant(1, std::sin(0.3 * k + 1.0)), 3.0 * std::sin(0.3 * k + 1.0) + 0.1};
    residuals += std::abs(row.output - row.regressor[0] * estimator.parameters()[0]);
    outputs += std::abs(row.output);
    estimator.update(row);
  }
  EXPECT_NEAR(estimator.explained(), 1.0 - residuals / outputs, 1e-12);
}

TEST(RecursiveLeastSquares, RefusesWrongOptions) {
  EXPECT_THROW(RecursiveLeastSquares(2, {1.01, 1e5, InitialVariance::kRelative}), std::invalid_argument);
  EXPECT_THROW(RecursiveLeastSquares(2, {0.0, 1e5, InitialVariance::kRelative}), std::invalid_argument);
  EXPECT_THROW(RecursiveLeastSquares(2, {0.98, 0.0, InitialVariance::kRelative}), std::invalid_argument);
  EXPECT_THROW(RecursiveLeastSquares(2, {0.98, std::nan(""), InitialVariance::kRelative}), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
