#include "suspension_health_monitor/internal/signal/lost_readings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace suspension_health_monitor {
namespace {

constexpr int kLearnt = 400;  // readings

/// Readings k by a constant and three sines, which any 1 + 2 * 3 of them tell exactly.
double sines(int k) { return 9.81 + std::sin(0.3 * k) + 0.5 * std::sin(1.1 * k + 1.0) + 0.2 * std::sin(2.3 * k + 2.0); }

template <class Signal>
LostReadings learnt(Signal&& signal) {
  LostReadings readings;
  for (int k = 0; k < kLearnt; ++k) readings.add(signal(k));
  return readings;
}

/// Readings after `lost` ones that follow reading kLearnt - 1; without those at `missing`.
template <class Signal>
std::vector<LostReadings::Known> after(int lost, Signal&& signal, const std::vector<int>& missing = {}) {
  std::vector<LostReadings::Known> known;
  for (int place = lost + 1; place <= LostReadings::kWindow - LostReadings::kReach; ++place)
    if (std::find(missing.begin(), missing.end(), place) == missing.end())
      known.push_back({place, signal(kLearnt - 1 + place)});
  return known;
}

TEST(LostReadings, FollowSinesOfAnyFrequency) {
  for (int lost = 1; lost <= LostReadings::kMost; ++lost)
    for (const std::vector<int>& missing : {std::vector<int>{}, std::vector<int>{5, 6, 9}}) {
      const std::vector<double> predicted = learnt(sines).predict(lost, after(lost, sines, missing));
      ASSERT_EQ(predicted.size(), static_cast<std::size_t>(lost));
      for (int k = 0; k < lost; ++k) EXPECT_NEAR(predicted[k], sines(kLearnt + k), 1e-4) << lost << ' ' << k;
    }
}

// White noise cannot be predicted: the best weights are 0. Fitted to n windows, 26 weights predict with a variance of
// 26 / (n - 26) of the noise's own.
TEST(LostReadings, SayNothingOfWhiteNoise) {
  double squares = 0.0;
  constexpr int kSeeds = 200;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::normal_distribution<double> normal;
    const auto noise = [&](int) { return normal(random); };
    squares += std::pow(learnt(noise).predict(1, after(1, noise)).front(), 2) / kSeeds;
  }
  const double windows = kLearnt - LostReadings::kWindow + 1, expected = 26.0 / (windows - 26.0);
  EXPECT_LT(squares, expected * (1.0 + 4.0 * std::sqrt(2.0 / kSeeds)));
}

TEST(LostReadings, AreNotDisturbedByABlow) {
  const auto blow = [](int k) { return k == kLearnt / 2 ? 300.0 : sines(k); };
  EXPECT_NEAR(learnt(blow).predict(1, after(1, sines)).front(), sines(kLearnt), 1e-3);
}

TEST(LostReadings, ArePredictedOnceTheStreamIsKnownAndTheReadingsBeforeThem) {
  LostReadings readings;
  int taken = 0;
  for (; !readings.isReady() && taken < kLearnt; ++taken) readings.add(sines(taken));
  EXPECT_EQ(taken, LostReadings::kWindow - 1 + 2 * LostReadings::kWindow);
  readings.startNewSeries();
  for (int k = 0; k < LostReadings::kReach; ++k) {
    EXPECT_FALSE(readings.isReady());
    readings.add(sines(k));
  }
  EXPECT_TRUE(readings.isReady());
}

}  // namespace
}  // namespace suspension_health_monitor
