#include "suspension_health_monitor/internal/signal/sampling_limit_power.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace suspension_health_monitor {
namespace {

constexpr double kMemory = 1000.0;  // values

TEST(SamplingLimitPower, IsThatOfWhiteMotion) {
  std::mt19937_64 engine(8);
  std::normal_distribution<double> white(0.0, 3.0);
  SamplingLimitPower power(1.0);
  for (int k = 0; k < 20000; ++k) power.add(white(engine));
  // A sixteenth of 20 000 independent values, 4 of their standard deviations; what is limited takes a little.
  EXPECT_NEAR(power.density(), 1.0, 4.0 * std::sqrt(2.0 / 1250.0));
  EXPECT_NEAR(power.level(), 3.0, 0.5 * 4.0 * std::sqrt(2.0 / 1250.0) * 3.0);
}

TEST(SamplingLimitPower, IsAllOfWhatAlternatesAndNoneOfWhatIsSlow) {
  SamplingLimitPower alternating(1.0), slow(1.0);
  for (int k = 0; k < 1000; ++k) {
    alternating.add(k % 2 == 0 ? 2.0 : -2.0);
    slow.add(2.0 * std::sin(2.0 * M_PI * 0.0625 * k));  // a period per window
  }
  EXPECT_NEAR(alternating.density(), 16.0, 1e-9);
  EXPECT_NEAR(alternating.level(), 2.0 * 4.0, 1e-9);
  EXPECT_NEAR(slow.density(), 0.0, 1e-9);
}

TEST(SamplingLimitPower, OfWhatStandsStillIsNone) {
  SamplingLimitPower power(1.0);
  for (int k = 0; k < 100; ++k) power.add(0.0);
  EXPECT_EQ(power.density(), 0.0);
  EXPECT_EQ(power.level(), 0.0);
}

// 16 windows hold a reading; each counts for at most the mean and three mean distances of 1.5 of it.
TEST(SamplingLimitPower, AReadingOfAnySizeCountsNoMoreThanAStrongOne) {
  for (const double size : {1e3, -1e100}) {
    SamplingLimitPower power(1.0 - 1.0 / kMemory);
    for (int k = 0; k < 10000; ++k) power.add(k == 9999 - 20 ? size : std::sin(0.3 * k));
    EXPECT_LT(power.density(), 16.0 / kMemory * 5.5) << size;
  }
}

// A gap is no step of the signal.
TEST(SamplingLimitPower, NoWindowGoesAcrossAGap) {
  SamplingLimitPower power(1.0);
  for (int k = 0; k < 160; ++k) {
    if (k % 16 == 0) power.startNewSeries();
    power.add(k / 16 % 2 == 0 ? 1.0 : -1.0);
  }
  EXPECT_NEAR(power.density(), 0.0, 1e-12);
}

}  // namespace
}  // namespace suspension_health_monitor
