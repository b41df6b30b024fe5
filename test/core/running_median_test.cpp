#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "suspension_health_monitor/internal/signal/stream_gate.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;  // [s]

TEST(RunningMedian, IsTheMedian) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal(0.0, 3.0);
  RunningMedian running(kPeriod);
  for (int k = 0; k < 100000; ++k) running.add(std::abs(normal(engine)));
  EXPECT_NEAR(running.median(), 0.6745 * 3.0, 0.05 * 2.0);  // quartile of the normal distribution
}

TEST(RunningMedian, IsNotKnownBeforeTenReadings) {
  RunningMedian running(kPeriod);
  for (int k = 0; k < 9; ++k) running.add(9.81);
  EXPECT_EQ(running.median(), 0.0);
  running.add(9.81);
  EXPECT_GT(running.median(), 0.0);
}

TEST(RunningMedian, LeavesAFirstReadingThatIsWrong) {
  RunningMedian running(kPeriod);
  running.add(1e12);
  for (int k = 0; k < 1000; ++k) running.add(9.81);
  EXPECT_NEAR(std::log(running.median() / 9.81), 0.0, 0.05);
}

TEST(RunningMedian, IsMovedByWrongReadingsOfAnySizeAlikeAndByNoMoreThanTenTimesInHalfAMinute) {
  for (const double wrong : {1e5, 1e300}) {
    RunningMedian running(kPeriod);
    for (int k = 0; k < 100000; ++k) running.add(9.81);
    for (int k = 0; k < 3000; ++k) running.add(wrong);
    EXPECT_NEAR(running.median(), 98.1, 5.0);
  }
}

TEST(RunningMedian, OutlivesASensorThatReadsNothingForDays) {
  RunningMedian running(kPeriod);
  for (int k = 0; k < 1000; ++k) running.add(9.81);
  for (int k = 0; k < 2000000; ++k) running.add(0.0);
  EXPECT_GT(running.median(), 0.0);
  for (int k = 0; k < 2000000; ++k) running.add(9.81);
  EXPECT_NEAR(running.median(), 9.81, 0.1);
}

}  // namespace
}  // namespace suspension_health_monitor
