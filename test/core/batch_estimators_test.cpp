#include "reference/batch_estimators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "paper_drive.h"
#include "random_rows.h"

namespace suspension_health_monitor {
namespace {

const Eigen::VectorXd kTheta = vectorOf({2.0, -0.5, 30.0});

RegressionRows noisyRows(int count, double noise = 0.1, unsigned seed = 1) {
  return stack(randomRows(kTheta, count, noise, seed));
}

// psi with every tenth value replaced by nonsense.
RegressionRows rowsWithOutliers(int count) {
  RegressionRows rows = noisyRows(count);
  for (Eigen::Index i = 0; i < rows.outputs.size(); i += 10) rows.outputs[i] += 500.0 + static_cast<double>(i);
  return rows;
}

TEST(ForgettingWeights, GiveTheNewestRowWeightOne) {
  const Eigen::VectorXd weights = forgettingWeights(4, 0.5);
  EXPECT_EQ(weights, Eigen::Vector4d(0.125, 0.25, 0.5, 1.0));
  EXPECT_THROW(forgettingWeights(4, 1.1), std::invalid_argument);
  EXPECT_THROW(forgettingWeights(4, 0.0), std::invalid_argument);
}

TEST(BatchLeastSquares, SolvesTheNormalEquations14) {
  const RegressionRows rows = noisyRows(200);
  for (const double lambda : {1.0, 0.97}) {
    const Eigen::VectorXd weights = forgettingWeights(200, lambda);
    const Eigen::VectorXd theta = batchLeastSquares(rows, lambda).value();
    const Eigen::VectorXd gradient =
        rows.regressors.transpose() * weights.asDiagonal() * (rows.outputs - rows.regressors * theta);
    EXPECT_LT(gradient.norm(), 1e-10);
    EXPECT_LT((theta - kTheta).norm(), 6.0 * 0.1 * std::sqrt(3.0 / std::min(200.0, 1.0 / (1.0 - lambda + 1e-9))));
  }
}

TEST(BatchLeastSquares, ForgettingFollowsTheNewestRows) {
  RegressionRows rows = noisyRows(400, 0.0);
  rows.outputs.tail(200) = rows.regressors.bottomRows(200) * (2.0 * kTheta);
  EXPECT_LT((batchLeastSquares(rows, 0.9).value() - 2.0 * kTheta).norm(), 1e-6);
}

TEST(BatchLeastSquares, DoesNotDependOnTheUnitsOfTheColumns) {
  RegressionRows rows = noisyRows(50);
  const Eigen::VectorXd theta = batchLeastSquares(rows).value();
  const Eigen::VectorXd units = vectorOf({1e-9, 1.0, 1e12});
  rows.regressors = rows.regressors * units.asDiagonal();
  const Eigen::VectorXd scaled = batchLeastSquares(rows).value();
  EXPECT_LT((scaled.cwiseProduct(units) - theta).norm(), 1e-12 * theta.norm());
}

TEST(BatchLeastSquares, SaysNothingWhereTheRowsDoNotDetermineTheParameters) {
  RegressionRows rows = noisyRows(50);
  EXPECT_FALSE(batchLeastSquares(RegressionRows{rows.regressors.topRows(2), rows.outputs.head(2)}).has_value());
  RegressionRows dependent = rows;
  dependent.regressors.col(2) = 3.0 * rows.regressors.col(0) - rows.regressors.col(1);
  EXPECT_FALSE(batchLeastSquares(dependent).has_value());
  RegressionRows zero = rows;
  zero.regressors.col(1).setZero();
  EXPECT_FALSE(batchLeastSquares(zero).has_value());
  RegressionRows broken = rows;
  broken.outputs[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(batchLeastSquares(broken).has_value());
  EXPECT_FALSE(batchLeastAbsolute(dependent).has_value());
}

TEST(BatchLeastSquares, RefusesSizesThatDisagree) {
  RegressionRows rows = noisyRows(50);
  rows.outputs.conservativeResize(49);
  EXPECT_THROW(batchLeastSquares(rows), std::invalid_argument);
}

TEST(BatchLeastAbsolute, OfAConstantIsTheWeightedMedian) {
  const std::vector<double> values{7.0, -3.0, 2.0, 1.0, 100.0};
  const RegressionRows rows{Eigen::MatrixXd::Ones(5, 1), Eigen::Map<const Eigen::VectorXd>(values.data(), 5)};
  EXPECT_NEAR(batchLeastAbsolute(rows)->parameters[0], 2.0, 1e-4);
  // Weights 1/16, 1/8, 1/4, 1/2, 1: the newest value alone outweighs the others.
  BatchLeastAbsoluteOptions options;
  options.forgetting_factor = 0.5;
  EXPECT_NEAR(batchLeastAbsolute(rows, options)->parameters[0], 100.0, 1e-3);
}

TEST(BatchLeastAbsolute, NeverLetsTheCriterionRise) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RegressionRows rows = noisyRows(60, 0.3, seed);
    if (seed % 2 == 0) rows.outputs.head(10).array() += 40.0;
    for (const double threshold : {0.0, 1e-8, 1e-3, 0.5}) {
      BatchLeastAbsoluteOptions options;
      options.small_divisor = threshold;
      options.min_decrease = 0.0;
      options.forgetting_factor = seed % 3 == 0 ? 0.95 : 1.0;
      const Eigen::VectorXd weights = forgettingWeights(60, options.forgetting_factor);
      double before = leastAbsoluteCriterion(rows, weights, batchLeastSquares(rows, weights).value());
      for (options.max_iterations = 1; options.max_iterations <= 40; ++options.max_iterations) {
        const auto estimate = batchLeastAbsolute(rows, options);
        EXPECT_LE(estimate->criterion, before);
        EXPECT_DOUBLE_EQ(estimate->criterion, leastAbsoluteCriterion(rows, weights, estimate->parameters));
        before = estimate->criterion;
      }
    }
  }
}

// A minimum of the convex criterion is one where no step along any direction lowers it.
TEST(BatchLeastAbsolute, FindsTheMinimumOfTheCriterion) {
  const RegressionRows rows = rowsWithOutliers(300);
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(300);
  const auto estimate = batchLeastAbsolute(rows);
  ASSERT_TRUE(estimate->converged);
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 1000; ++trial) {
    Eigen::VectorXd other = estimate->parameters;
    for (double& entry : other) entry += 0.01 * normal(engine);
    EXPECT_GT(leastAbsoluteCriterion(rows, weights, other), estimate->criterion * (1.0 - 1e-6));
  }
}

TEST(BatchLeastAbsolute, ShrugsOffOutliersThatCarryLeastSquaresAway) {
  const RegressionRows rows = rowsWithOutliers(300);
  EXPECT_GT((batchLeastSquares(rows).value() - kTheta).norm(), 1.0);
  // 6 standard deviations of LA under normal noise, sigma sqrt(pi/2 / N) per parameter, N = 270 good rows.
  EXPECT_LT((batchLeastAbsolute(rows)->parameters - kTheta).norm(), 6.0 * 0.1 * std::sqrt(3.0 * 1.571 / 270.0));
}

TEST(BatchLeastAbsolute, DoesNotDependOnTheUnitOfTheOutputWithRelativeRules) {
  const RegressionRows rows = rowsWithOutliers(100);
  const auto metres = batchLeastAbsolute(rows);
  const auto centimetres = batchLeastAbsolute(RegressionRows{rows.regressors, 100.0 * rows.outputs});
  EXPECT_EQ(metres->iterations, centimetres->iterations);
  EXPECT_LT((centimetres->parameters / 100.0 - metres->parameters).norm(), 1e-9);
}

TEST(BatchLeastAbsolute, StopsByTheAbsoluteDecreaseOfThePaper) {
  const RegressionRows rows = rowsWithOutliers(100);
  BatchLeastAbsoluteOptions options;
  options.stopping_rule = StoppingRule::kAbsolute;
  options.small_divisor_rule = SmallDivisor::kAbsolute;
  options.small_divisor = 1e-8;
  options.min_decrease = 1e-6;
  const auto fine = batchLeastAbsolute(rows, options);
  EXPECT_TRUE(fine->converged);
  options.min_decrease = 1e3;
  const auto coarse = batchLeastAbsolute(rows, options);
  EXPECT_TRUE(coarse->converged);
  EXPECT_LT(coarse->iterations, fine->iterations);
  options.min_decrease = 1e-6;
  const RegressionRows tiny{rows.regressors, 1e-12 * rows.outputs};
  EXPECT_EQ(batchLeastAbsolute(tiny, options)->iterations, 1) << "the absolute rule sees nothing in tiny units";
}

TEST(BatchLeastAbsolute, ReportsThatTheIterationsRanOut) {
  BatchLeastAbsoluteOptions options;
  options.max_iterations = 2;
  const auto estimate = batchLeastAbsolute(rowsWithOutliers(100), options);
  EXPECT_EQ(estimate->iterations, 2);
  EXPECT_FALSE(estimate->converged);
}

TEST(BatchLeastAbsolute, IsExactOnExactRows) {
  const auto estimate = batchLeastAbsolute(noisyRows(50, 0.0));
  EXPECT_TRUE(estimate->converged);
  EXPECT_LT((estimate->parameters - kTheta).norm(), 1e-12);
}

TEST(BatchLeastAbsolute, RefusesWrongOptionsByName) {
  const auto refusal = [](const BatchLeastAbsoluteOptions& options) -> std::string {
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  BatchLeastAbsoluteOptions options;
  EXPECT_EQ(refusal(options), "");
  options.max_iterations = 0;
  EXPECT_NE(refusal(options).find("la/max_iterations = 0"), std::string::npos);
  options = {};
  options.min_decrease = std::nan("");
  EXPECT_NE(refusal(options).find("la/min_decrease = nan"), std::string::npos);
  options = {};
  options.small_divisor = -1.0;
  EXPECT_NE(refusal(options).find("la/small_divisor = -1"), std::string::npos);
  options = {};
  options.forgetting_factor = 1.5;
  EXPECT_NE(refusal(options).find("forgetting_factor = 1.5"), std::string::npos);
}

// The strut of a healthy drive, 60 s; the noise alone leaves errors of about 0.01 and 0.03.
TEST(BatchLeastAbsolute, IdentifiesThePapersStrut) {
  const RegressionRows rows =
      stack(strutRows(healthyPaperDrive(60.0, 0.024), {30, 0.02, IntegrationRule::kBandLimited}));
  const auto estimate = batchLeastAbsolute(rows);
  EXPECT_TRUE(estimate->converged);
  EXPECT_NEAR(estimate->parameters[kDampingToMass], kPaperB1, 0.03);
  EXPECT_NEAR(estimate->parameters[kStiffnessToMass], kPaperB0, 0.1);
}

}  // namespace
}  // namespace suspension_health_monitor
