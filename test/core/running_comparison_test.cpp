#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/internal/math/running_means.h"

namespace suspension_health_monitor {
namespace {

TEST(RunningMean, IsTheWeightedMeanFromTheFirstValueOn) {
  RunningMean mean(0.9);
  EXPECT_EQ(mean.mean(), 0.0);
  EXPECT_EQ(mean.weight(), 0.0);
  const std::vector<double> values{3.0, -1.0, 4.0, 1.0, -5.0};
  double sum = 0.0, weight = 0.0;
  for (const double value : values) {
    mean.add(value);
    sum = 0.9 * sum + value;
    weight = 0.9 * weight + 1.0;
    ASSERT_NEAR(mean.mean(), sum / weight, 1e-15);
    ASSERT_NEAR(mean.weight(), weight, 1e-15);
  }
}

TEST(RunningMean, HasTheWeightOfItsMemory) {
  RunningMean fading(0.98), lasting(1.0);
  for (int k = 0; k < 2000; ++k) {
    fading.add(1.0);
    lasting.add(k);
  }
  EXPECT_NEAR(fading.weight(), 50.0, 1e-12);
  EXPECT_EQ(lasting.weight(), 2000.0);
  EXPECT_NEAR(lasting.mean(), 999.5, 1e-9);
}

TEST(RunningComparison, EqualsTheBatchFiguresWithoutForgetting) {
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  RunningComparison comparison(1.0);
  std::vector<double> measured, residual;
  for (int k = 0; k < 500; ++k) {
    measured.push_back(2.0 + 3.0 * normal(engine));
    residual.push_back(0.4 + 0.5 * normal(engine));
    comparison.add(measured.back(), measured.back() - residual.back());
  }
  EXPECT_NEAR(comparison.rmse(), standardDeviationOf(residual), 1e-12);
  EXPECT_NEAR(comparison.fitPercent(), 100.0 * (1.0 - standardDeviationOf(residual) / standardDeviationOf(measured)),
              1e-10);
}

TEST(RunningComparison, ForgetsWhatIsOlderThanItsWindow) {
  RunningComparison comparison(0.99);
  for (int k = 0; k < 1000; ++k) comparison.add(std::sin(0.3 * k), 50.0 * std::cos(k));
  for (int k = 0; k < 3000; ++k) comparison.add(std::sin(0.3 * k), 0.75 * std::sin(0.3 * k));
  EXPECT_NEAR(comparison.rmse(), 0.25 * std::sqrt(0.5), 0.02 * 0.25);  // ripple of a window of 100 samples
  EXPECT_NEAR(comparison.fitPercent(), 75.0, 1e-3);
}

TEST(RunningComparison, FitIs100ForAPerfectModelAnd0ForAConstantAndBelowForAWorseOne) {
  RunningComparison perfect(0.99), constant(0.99), opposite(0.99);
  for (int k = 0; k < 500; ++k) {
    const double y = std::sin(0.1 * k);
    perfect.add(y, y);
    constant.add(y, 0.7);
    opposite.add(y, -y);
  }
  EXPECT_EQ(perfect.rmse(), 0.0);
  EXPECT_EQ(perfect.fitPercent(), 100.0);
  EXPECT_NEAR(constant.fitPercent(), 0.0, 1e-9);
  EXPECT_NEAR(opposite.fitPercent(), -100.0, 1e-9);
}

TEST(RunningComparison, SaysWhetherAConstantWouldDoBetter) {
  RunningComparison good(0.99), bad(0.99);
  for (int k = 0; k < 500; ++k) {
    const double y = 9.81 + std::sin(0.1 * k);
    good.add(y, 0.3 + 0.1 * std::sin(0.1 * k));  // a tenth of the motion, with an offset
    bad.add(y, -0.1 * std::sin(0.1 * k));
    EXPECT_FALSE(k < 68 && bad.isWorseThanConstant()) << k;  // half a window: 100 ln 2 samples
  }
  EXPECT_FALSE(good.isWorseThanConstant());
  EXPECT_TRUE(bad.isWorseThanConstant());
}

TEST(RunningComparison, IsNoWorseThanAConstantForAReadingThatIsWrong) {
  RunningComparison comparison(0.99);
  for (int k = 0; k < 500; ++k) {
    const double y = std::sin(0.1 * k);
    comparison.add(y, 0.9 * y + (k == 400 ? 1e6 : 0.0));
    EXPECT_FALSE(k > 68 && comparison.isWorseThanConstant()) << k;
  }
  EXPECT_LT(comparison.fitPercent(), 0.0);
}

TEST(RunningComparison, LeavesOutAConstantDifference) {
  RunningComparison offset(0.99), none(0.99);
  for (int k = 0; k < 500; ++k) {
    const double y = std::sin(0.1 * k), predicted = 0.9 * std::sin(0.1 * k + 0.1);
    offset.add(y + 9.81, predicted - 0.3);
    none.add(y, predicted);
  }
  EXPECT_NEAR(offset.rmse(), none.rmse(), 1e-10);
  EXPECT_NEAR(offset.fitPercent(), none.fitPercent(), 1e-8);
}

TEST(RunningComparison, FitIsNotANumberWhileNothingMoves) {
  RunningComparison comparison(0.99);
  EXPECT_EQ(comparison.rmse(), 0.0);
  EXPECT_TRUE(std::isnan(comparison.fitPercent()));
  for (int k = 0; k < 100; ++k) comparison.add(2.0, 2.0);
  EXPECT_TRUE(std::isnan(comparison.fitPercent()));
}

}  // namespace
}  // namespace suspension_health_monitor
