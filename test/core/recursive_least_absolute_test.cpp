#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "paper_drive.h"
#include "random_rows.h"
#include "reference/batch_estimators.h"
#include "suspension_health_monitor/internal/identification/recursive_estimators.h"

namespace suspension_health_monitor {
namespace {

const Eigen::VectorXd kTheta = vectorOf({3.0, -14.0});

template <class Estimator>
Eigen::VectorXd estimate(const std::vector<RegressionRow>& rows, const RecursiveOptions& options = {}) {
  Estimator estimator(static_cast<int>(rows.front().regressor.size()), options);
  for (const RegressionRow& row : rows) estimator.update(row);
  return estimator.parameters();
}

// Exponential values: median ln 2 = 0.693, mean 1.
TEST(RecursiveLeastAbsolute, OfAConstantTendsToTheMedianWhereLeastSquaresTendsToTheMean) {
  std::mt19937_64 engine(1);
  std::exponential_distribution<double> exponential;
  RecursiveOptions fine{0.99, 1e5, InitialVariance::kRelative};
  fine.small_divisor = 0.01;
  RecursiveLeastSquares ls(1, fine);
  RecursiveLeastAbsolute la(1, fine);
  double ls_sum = 0.0, la_sum = 0.0;
  const int count = 50'000;
  for (int k = 0; k < count; ++k) {
    const RegressionRow row{Eigen::VectorXd::Ones(1), exponential(engine)};
    ls.update(row);
    la.update(row);
    ls_sum += ls.parameters()[0];
    la_sum += la.parameters()[0];
  }
  // The mean over 50 000 values has a standard deviation of 0.0045; the median of a memory of 100 has a bias of 0.005.
  EXPECT_NEAR(ls_sum / count, 1.0, 0.03);
  EXPECT_NEAR(la_sum / count, std::log(2.0), 0.03);
}

std::vector<RegressionRow> rowsWithOutliers(int count) {
  auto rows = randomRows(kTheta, count, 0.1, 2);
  for (std::size_t k = 200; k < rows.size(); k += 10) rows[k].output += 100.0;
  return rows;
}

TEST(RecursiveLeastAbsolute, ShrugsOffOutliersThatCarryLeastSquaresAway) {
  const auto rows = rowsWithOutliers(2000);
  EXPECT_GT((estimate<RecursiveLeastSquares>(rows) - kTheta).norm(), 1.0);
  // One standard deviation of LS without outliers over 50 rows is 0.1 sqrt(2 / 50) = 0.02.
  EXPECT_LT((estimate<RecursiveLeastAbsolute>(rows) - kTheta).norm(), 0.15);
}

TEST(RecursiveLeastAbsolute, FollowsLeastSquaresUntilItTakesOver) {
  const auto rows = randomRows(kTheta, 20, 0.1, 3);
  RecursiveOptions options;
  options.start_rows = 10;
  RecursiveLeastSquares ls(2, {});
  RecursiveLeastAbsolute la(2, options);
  for (int k = 0; k < 20; ++k) {
    const auto& row = rows[static_cast<std::size_t>(k)];
    EXPECT_EQ(ls.update(row) == la.update(row), k <= 10) << "row " << k;
    EXPECT_EQ(ls.parameters() == la.parameters(), k < 10) << "row " << k;
  }
}

// Eq. (24)-(26) as printed, for a start from LS.
TEST(RecursiveLeastAbsolute, IsEquations24To26WithThePapersSettings) {
  const auto rows = randomRows(kTheta, 200, 0.1, 4);
  const RecursiveOptions paper{0.98, 1e5,  InitialVariance::kAbsolute, 0, false, 50, SmallDivisor::kAbsolute,
                               1e-8, false};
  RecursiveLeastAbsolute la(2, paper);
  Eigen::MatrixXd p;
  Eigen::VectorXd theta;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    la.update(rows[k]);
    if (k < 50) {
      p = la.covariance().matrix();
      theta = la.parameters();
      continue;
    }
    const Eigen::VectorXd& phi = rows[k].regressor;
    const double epsilon = rows[k].output - phi.dot(theta);
    const Eigen::VectorXd p_phi = p * phi;
    p = (p - p_phi * p_phi.transpose() / (0.98 * std::abs(epsilon) + phi.dot(p_phi))) / 0.98;
    theta += p * phi * (epsilon > 0.0 ? 1.0 : -1.0);
    EXPECT_LT((la.parameters() - theta).norm(), 1e-8) << "row " << k;
    EXPECT_LT((la.covariance().matrix() - p).norm(), 1e-6 * p.norm()) << "row " << k;
  }
}

Eigen::VectorXd strutEstimateIn(double unit, const RecursiveOptions& options) {
  auto drive = healthyPaperDrive(30.0, 0.024);
  for (CornerSample& sample : drive) {
    sample.sprung_acceleration *= unit;
    sample.unsprung_acceleration *= unit;
  }
  return estimate<RecursiveLeastAbsolute>(strutRows(drive, {}), options);
}

TEST(RecursiveLeastAbsolute, GivesTheSameValuesInMetresAndCentimetresByDefault) {
  const Eigen::VectorXd metres = strutEstimateIn(1.0, {});
  for (const double unit : {100.0, 0.01, 1e6})
    EXPECT_LT((strutEstimateIn(unit, {}) - metres).norm(), 1e-9 * metres.norm()) << "unit " << unit;
  EXPECT_NEAR(metres[kDampingToMass], kPaperB1, 0.3);
  EXPECT_NEAR(metres[kStiffnessToMass], kPaperB0, 0.6);
}

TEST(RecursiveLeastAbsolute, DependsOnTheUnitWithoutTheScaledHandOver) {
  RecursiveOptions unscaled;
  unscaled.scale_covariance_at_start = false;
  unscaled.start_rows = 1400;  // shortly before the end, so that the hand-over still shows
  EXPECT_GT((strutEstimateIn(1e3, unscaled) - strutEstimateIn(1.0, unscaled)).norm(), 1e-6);
}

TEST(RecursiveLeastAbsolute, IgnoresARowOfZerosAndSurvivesRowsHitExactly) {
  RecursiveOptions options;
  options.start_rows = 5;
  options.small_divisor_rule = SmallDivisor::kAbsolute;
  options.small_divisor = 0.0;
  RecursiveLeastAbsolute la(2, options);
  for (const RegressionRow& row : randomRows(kTheta, 500, 0.0, 5)) la.update(row);
  EXPECT_LT((la.parameters() - kTheta).norm(), 1e-4);
  EXPECT_TRUE(la.covariance().matrix().allFinite());
  const Eigen::VectorXd theta = la.parameters();
  EXPECT_EQ(la.update({Eigen::VectorXd::Zero(2), 7.0}), 7.0);
  EXPECT_EQ(la.parameters(), theta);
}

TEST(SmallDivisorRule, BoundsTheDivisorAbsolutelyOrByTheResidualScale) {
  EXPECT_EQ(boundedDivisor(-0.5, SmallDivisor::kAbsolute, 0.1, 100.0), 0.5);
  EXPECT_EQ(boundedDivisor(0.05, SmallDivisor::kAbsolute, 0.1, 100.0), 0.1);
  EXPECT_EQ(boundedDivisor(0.5, SmallDivisor::kRelative, 0.1, 100.0), 10.0);
  EXPECT_EQ(boundedDivisor(-50.0, SmallDivisor::kRelative, 0.1, 100.0), 50.0);
  EXPECT_GT(boundedDivisor(0.0, SmallDivisor::kRelative, 0.1, 0.0), 0.0);
}

}  // namespace
}  // namespace suspension_health_monitor
