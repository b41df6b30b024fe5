#include "suspension_health_monitor/internal/identification/variable_forgetting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace suspension_health_monitor {
namespace {

constexpr double kSlow = 0.995, kFastest = 0.97;
constexpr int kCorrelated = 60;     // 2 L
constexpr double kMemory = 3 * 61;  // rows

RegressionRow rowOf(double first, double second = 0.0) {
  RegressionRow row;
  row.regressor = Eigen::Vector2d(first, second);
  return row;
}

VariableForgetting twoParameters() { return {2, kCorrelated, kSlow, kFastest}; }

/// Rows whose scores, of full size, are as often above as below 0.
void addStill(VariableForgetting& forgetting, int rows) {
  for (int k = 0; k < rows; ++k) forgetting.add(rowOf(1.0, 1.0), k % 2 == 0 ? 2.0 : -2.0, 1.0);
}

TEST(VariableForgetting, DriftIsTheSquaredCorrelationOverThreeWindows) {
  VariableForgetting forgetting = twoParameters();
  EXPECT_EQ(forgetting.drift(), 0.0);
  EXPECT_EQ(forgetting.factor(), kSlow);
  for (int k = 1; k <= 400; ++k) {
    const double sign = k % 3 == 0 ? 1.0 : -1.0;
    forgetting.add(rowOf(0.0, -2.0 * sign), 7.0 * sign, 7.0);  // of the second parameter, which has fallen
    ASSERT_NEAR(forgetting.drift(), 1.0 - std::pow(1.0 - 1.0 / kMemory, k), 1e-12) << k;
  }
  EXPECT_EQ(forgetting.factor(), kFastest);
}

TEST(VariableForgetting, OneWindowOfRowsAllOfOneSignIsTheMostThatChangesNothing) {
  VariableForgetting forgetting = twoParameters();
  addStill(forgetting, 4000);
  const auto add = [&](int rows) {
    for (int k = 0; k < rows; ++k) forgetting.add(rowOf(1.0, k % 2 == 0 ? 1.0 : -1.0), 2.0, 1.0);
  };
  add(kCorrelated + 1);
  EXPECT_NEAR(forgetting.drift(), std::pow(1.0 - std::exp(-1.0 / 3.0), 2), 2e-3);
  EXPECT_NEAR(forgetting.factor(), kSlow, 0.02 * (kSlow - kFastest));
  add(10);
  EXPECT_LT(forgetting.factor(), kSlow - 0.1 * (kSlow - kFastest));
  EXPECT_GT(forgetting.factor(), kFastest);
  // T = 2 t after -M ln(1 - sqrt(2 t)) = 94 rows.
  add(20);
  EXPECT_GT(forgetting.factor(), kFastest);
  add(6);
  EXPECT_EQ(forgetting.factor(), kFastest);
  addStill(forgetting, 4000);
  EXPECT_EQ(forgetting.factor(), kSlow);
}

// T of white scores is s^2 / q with Var s = q / (2 M - 1); 400 000 rows are 2000 memories, of which each gives a chi
// squared with a standard deviation of sqrt(2): 3 % of the mean, 10 % are three of them.
TEST(VariableForgetting, ChanceGivesHalfAMemoryOfDriftAndIsNotTakenForAChange) {
  VariableForgetting forgetting(1, kCorrelated, kSlow, kFastest);
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  double sum = 0.0, slow = 0.0;
  constexpr int kRows = 400000, kSettling = 2000;
  RegressionRow row;
  row.regressor = Eigen::VectorXd::Zero(1);
  for (int k = 0; k < kRows + kSettling; ++k) {
    row.regressor[0] = normal(generator);
    forgetting.add(row, normal(generator), std::sqrt(2.0 / M_PI));
    if (k < kSettling) continue;
    sum += forgetting.drift();
    slow += forgetting.factor() == kSlow ? 1.0 : 0.0;
  }
  EXPECT_NEAR(sum / kRows, 1.0 / (2.0 * kMemory - 1.0), 0.1 / (2.0 * kMemory - 1.0));
  EXPECT_EQ(slow, kRows);
}

TEST(VariableForgetting, AnOutlierCountsAsAnyOtherRowAndOneThatIsFarOffNotAtAll) {
  VariableForgetting outliers = twoParameters(), usual = twoParameters();
  for (int k = 0; k < 100; ++k) {
    outliers.add(rowOf(1.0), k % 4 == 0 ? 4.9 : 1.0, 1.0);
    usual.add(rowOf(1.0), 1.0, 1.0);
  }
  EXPECT_EQ(outliers.drift(), usual.drift());
  VariableForgetting far = twoParameters();
  addStill(far, 4000);
  const double before = far.drift();
  for (int k = 0; k < 300; ++k) far.add(rowOf(1.0), -5.1, 1.0);
  EXPECT_LE(far.drift(), before);
  EXPECT_EQ(far.factor(), kSlow);
}

TEST(VariableForgetting, IsFreeOfTheUnitsOfRowsAndParameters) {
  VariableForgetting one = twoParameters(), other = twoParameters();
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 3000; ++k) {
    const double first = normal(generator), second = normal(generator);
    const double innovation = normal(generator) + (k > 2000 ? 0.5 * first : 0.0);
    one.add(rowOf(first, second), innovation, 0.8);
    other.add(rowOf(1e-6 * first, 1e5 * second), 1e-3 * innovation, 0.8e-3);
    ASSERT_NEAR(one.factor(), other.factor(), 1e-12) << k;
  }
  EXPECT_LT(one.factor(), kSlow);
}

TEST(VariableForgetting, HasAMemoryOfAtLeastSixtyRowsAndTellsNothingFromRowsThatAreHit) {
  VariableForgetting white(1, 0, kSlow, kFastest);
  RegressionRow row;
  row.regressor = Eigen::VectorXd::Ones(1);
  white.add(row, 0.0, 0.0);
  EXPECT_EQ(white.factor(), kSlow);
  white.add(row, 1.0, 1.0);
  EXPECT_NEAR(white.drift(), 1.0 / 60.0, 1e-12);
  white.restart(1);
  EXPECT_EQ(white.drift(), 0.0);
}

}  // namespace
}  // namespace suspension_health_monitor
