#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "suspension_health_monitor/internal/signal/stream_gate.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;  // [s]

TEST(UsualSize, IsTheMedian) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal(0.0, 3.0);
  UsualSize usual(kPeriod);
  for (int k = 0; k < 100000; ++k) usual.add(std::abs(normal(engine)));
  EXPECT_NEAR(usual.median(), 0.6745 * 3.0, 0.05 * 2.0);  // quartile of the normal distribution
}

TEST(UsualSize, IsNotKnownBeforeTenReadings) {
  UsualSize usual(kPeriod);
  for (int k = 0; k < 9; ++k) usual.add(9.81);
  EXPECT_EQ(usual.median(), 0.0);
  usual.add(9.81);
  EXPECT_GT(usual.median(), 0.0);
}

TEST(UsualSize, LeavesAFirstReadingThatIsWrong) {
  UsualSize usual(kPeriod);
  usual.add(1e12);
  for (int k = 0; k < 1000; ++k) usual.add(9.81);
  EXPECT_NEAR(std::log(usual.median() / 9.81), 0.0, 0.05);
}

TEST(UsualSize, IsMovedByWrongReadingsOfAnySizeAlikeAndByNoMoreThanTenTimesInHalfAMinute) {
  for (const double wrong : {1e5, 1e300}) {
    UsualSize usual(kPeriod);
    for (int k = 0; k < 100000; ++k) usual.add(9.81);
    for (int k = 0; k < 3000; ++k) usual.add(wrong);
    EXPECT_NEAR(usual.median(), 98.1, 5.0);
  }
}

TEST(UsualSize, OutlivesASensorThatReadsNothingForDays) {
  UsualSize usual(kPeriod);
  for (int k = 0; k < 1000; ++k) usual.add(9.81);
  for (int k = 0; k < 2000000; ++k) usual.add(0.0);
  EXPECT_GT(usual.median(), 0.0);
  for (int k = 0; k < 2000000; ++k) usual.add(9.81);
  EXPECT_NEAR(usual.median(), 9.81, 0.1);
}

}  // namespace
}  // namespace suspension_health_monitor
