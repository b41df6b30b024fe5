#include "suspension_health_monitor/internal/signal/folded_power.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

constexpr double kForgetsNothing = 1.0;
constexpr int kSteps = 16;        // from value to value
constexpr double kCorner = 0.02;  // of the lags, of the rate of the values

/// White noise behind so many lags, of which every sixteenth value is taken.
double boundBehindLags(int lags) {
  std::mt19937_64 engine(8);
  std::normal_distribution<double> white;
  const double share = 2.0 * M_PI * kCorner / kSteps;
  std::vector<double> states(static_cast<std::size_t>(lags), 0.0);
  FoldedPower power(kForgetsNothing);
  for (int k = 0; k < 60000 * kSteps; ++k) {
    double value = white(engine);
    for (double& state : states) value = state += share * (value - state);
    if (k % kSteps == 0) power.add(value);
  }
  return std::pow(power.level(), 2);
}

/// What is folded back to 0 of it: the densities at the multiples of the rate, exactly.
double foldedBehindLags(int lags) {
  const double share = 2.0 * M_PI * kCorner / kSteps;
  double folded = 0.0;
  for (int k = 1; k < kSteps; ++k) {
    const double angle = 2.0 * M_PI * k / kSteps;
    const double gain = share * share / (1.0 - 2.0 * (1.0 - share) * std::cos(angle) + std::pow(1.0 - share, 2));
    folded += std::pow(gain, lags);
  }
  return folded / kSteps;
}

// Behind one lag the density falls by f^-2, behind two by f^-4.
TEST(FoldedPower, BoundsWhatIsFoldedOfMotionThatFallsByAPowerLaw) {
  for (const int lags : {1, 2}) {
    const double ratio = boundBehindLags(lags) / foldedBehindLags(lags);
    EXPECT_GT(ratio, 1.0) << lags;
    EXPECT_LT(ratio, 8.0) << lags;
  }
}

// Windows are limited to three mean deviations, which takes an eighth of those at half the rate and next to none of the
// others; that counts two and a half times.
TEST(FoldedPower, OfWhiteNoiseIsNearlyThat) {
  std::mt19937_64 engine(8);
  std::normal_distribution<double> white(0.0, 3.0);
  FoldedPower power(kForgetsNothing);
  for (int k = 0; k < 100000; ++k) power.add(9.81 + white(engine));
  // 3000 independent windows, of one square at half the rate and of two below; four standard deviations.
  const double error = std::hypot(2.5 * std::sqrt(2.0 / 3000.0), 1.5 * std::sqrt(1.0 / 3000.0));
  EXPECT_NEAR(std::pow(power.level() / 3.0, 2), 0.75, 4.0 * 0.75 * error);
  EXPECT_NEAR(std::pow(power.levelAtLimit() / 3.0, 2), 1.0, 4.0 * std::sqrt(2.0 / 3000.0));
}

TEST(FoldedPower, OfWhatIsSlowOrStandsStillIsNone) {
  FoldedPower slow(kForgetsNothing), still(kForgetsNothing);
  for (int k = 0; k < 1000; ++k) {
    slow.add(9.81 + std::sin(2.0 * M_PI * k / 32.0));
    still.add(0.0);
  }
  EXPECT_NEAR(slow.level(), 0.0, 1e-10);
  EXPECT_EQ(still.level(), 0.0);
}

// Eight windows hold a reading, a thirtieth of the memory. Each counts for three mean deviations at most, so that the
// density at half the rate is a tenth larger; the bound goes with its power of 2.5, and with chance of sixty windows.
TEST(FoldedPower, AReadingOfAnySizeCountsNoMoreThanStrongOnes) {
  std::mt19937_64 engine(8);
  std::normal_distribution<double> white;
  for (const double size : {1e3, -1e50}) {
    FoldedPower power(1.0 - 1.0 / 1000.0);
    double most = 0.0;
    for (int k = 0; k < 9000; ++k) {
      power.add(k == 2000 ? size : white(engine));
      if (k > 1000) most = std::max(most, power.level());
    }
    EXPECT_LT(most, 3.0) << size;
  }
}

TEST(FoldedPower, NoWindowGoesAcrossAGap) {
  FoldedPower power(kForgetsNothing);
  for (int k = 0; k < 640; ++k) {
    if (k % 64 == 0) power.interrupt();
    power.add(k / 64 % 2 == 0 ? 1.0 : -1.0);
  }
  EXPECT_NEAR(power.level(), 0.0, 1e-10);
}

}  // namespace
}  // namespace suspension_health_monitor
