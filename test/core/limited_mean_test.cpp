#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "suspension_health_monitor/internal/math/running_means.h"

namespace suspension_health_monitor {
namespace {

TEST(LimitedMean, IsTheMeanOfANormalVariable) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal(9.81, 2.0);
  LimitedMean limited(0.9999);
  for (int k = 0; k < 100000; ++k) limited.add(normal(engine));
  EXPECT_NEAR(limited.mean(), 9.81, 5.0 * 2.0 / std::sqrt(20000.0));  // that many independent values
  // Of |x| limited to three times itself, sqrt(2/pi) sigma less 1 %.
  EXPECT_NEAR(limited.deviation(), 2.0 * std::sqrt(2.0 / M_PI), 0.03 * 2.0);
}

TEST(LimitedMean, BeginsWithTheFirstValueWhateverItsSize) {
  LimitedMean limited(0.99);
  limited.add(-1e6);
  EXPECT_EQ(limited.mean(), -1e6);
  EXPECT_EQ(limited.deviation(), 0.0);
}

/// @return how far a value moves the mean of values of mean size 1, memory 1000.
double shiftBy(double value, int times) {
  LimitedMean limited(0.999);
  for (int k = 0; k < 10000; ++k) limited.add(k % 2 == 0 ? 1.0 : -1.0);
  for (int k = 0; k < times; ++k) limited.add(value);
  return limited.mean();
}

TEST(LimitedMean, MovesByNoMoreThanThreeDeviationsForAValueOfAnySize) {
  EXPECT_NEAR(shiftBy(1e40, 1), 3e-3, 6e-4);
  EXPECT_NEAR(shiftBy(-1e300, 1), -3e-3, 6e-4);
  EXPECT_NEAR(shiftBy(2.0, 1), 2e-3, 6e-4);  // within three
}

TEST(LimitedMean, IsMovedByHalfAMemoryOfWrongValuesOfAnySizeAlike) {
  EXPECT_NEAR(shiftBy(1e300, 500) / shiftBy(1e4, 500), 1.0, 1e-9);
  EXPECT_LT(shiftBy(1e300, 500), 3.0 * std::exp(1.0));  // the usual has grown by e at the end
}

TEST(LimitedMean, FollowsAStepInTheEnd) {
  LimitedMean limited(0.99);
  for (int k = 0; k < 1000; ++k) limited.add(k % 2 == 0 ? 0.01 : -0.01);
  for (int k = 0; k < 3000; ++k) limited.add(9.81 + (k % 2 == 0 ? 0.01 : -0.01));
  EXPECT_NEAR(limited.mean(), 9.81, 0.01);
}

}  // namespace
}  // namespace suspension_health_monitor
