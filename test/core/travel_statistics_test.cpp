#include "suspension_health_monitor/internal/compare/travel_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 6.0, kB0 = 63.3, kPeriod = 0.01, kFrequency = 1.7, kTurn = 2.0 * M_PI * kFrequency;
constexpr int kSamples = 6000, kCycles = 102;
constexpr double kEnds = 1.5 / kCycles;  // a cycle that is cut, and what the record loses at its ends

/// Steady motion over a wheel that goes up and down with 3 m/s^2: travel of amplitude 3 / |b0 - w^2 + i b1 w|.
const std::complex<double> kTravel = 3.0 / std::complex<double>(kB0 - kTurn * kTurn, kB1* kTurn);

Drive steadyDrive() {
  std::vector<double> body, wheel;
  for (int k = 0; k < kSamples; ++k) {
    const std::complex<double> turned = std::polar(1.0, kTurn * kPeriod * k);
    wheel.push_back(std::real(3.0 * turned));
    body.push_back(std::real(kTravel * std::complex<double>(kB0, kB1 * kTurn) * turned));
  }
  return makeDrive(kPeriod, body, wheel);
}

/// Of a sine the share of the time below x is 1/2 + asin(x / amplitude) / pi.
void expectSine(const TimeHistogram& histogram, double amplitude) {
  const auto below = [&](double x) { return 0.5 + std::asin(std::clamp(x / amplitude, -1.0, 1.0)) / M_PI; };
  ASSERT_EQ(histogram.edges.size(), histogram.shares.size() + 1);
  double sum = 0.0;
  for (std::size_t i = 0; i < histogram.shares.size(); ++i) {
    sum += histogram.shares[i];
    EXPECT_NEAR(sum, below(histogram.edges[i + 1]) - below(histogram.edges[0]), kEnds) << histogram.edges[i];
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
  for (const TimeHistogram::Direction& direction : {histogram.compression, histogram.rebound}) {
    EXPECT_NEAR(direction.share, 0.5, kEnds);
    EXPECT_NEAR(direction.mean, 2.0 / M_PI * amplitude, kEnds * amplitude);
    EXPECT_NEAR(direction.largest, amplitude, kEnds * amplitude);
  }
}

TEST(TravelStatistics, AreThoseOfASine) {
  const TravelStatistics found = travelStatistics({steadyDrive()}, {kB1, kB0, {}, {}}, kPeriod);
  expectSine(found.travel, std::abs(kTravel));
  expectSine(found.travel_rate, std::abs(kTravel) * kTurn);
  EXPECT_TRUE(found.stops.empty());
}

TEST(TravelStatistics, CountAHitPerCycleAndTheTimeNearAStop) {
  StrutModel model{kB1, kB0, {}, {}};
  const double gap = 0.8 * std::abs(kTravel);
  for (const char* name : {"bump_stop", "rebound_stop"})
    model.effects.push_back({findEffect(forceEffects(), name), 1e-6, {gap}});  // so soft that the motion stays a sine
  const TravelStatistics found = travelStatistics({steadyDrive()}, model, kPeriod);
  ASSERT_EQ(found.stops.size(), 2U);
  for (const StopUse& stop : found.stops) {
    EXPECT_EQ(stop.gap, gap);
    EXPECT_NEAR(stop.hits, kCycles, 2);
    EXPECT_NEAR(stop.near, std::acos(0.9 * 0.8) / M_PI, kEnds);
  }
  EXPECT_EQ(found.stops.front().effect, "bump_stop");
}

TEST(TravelStatistics, AreEmptyWithoutMotion) {
  const std::vector<double> still(200, 0.0);
  EXPECT_TRUE(travelStatistics({makeDrive(kPeriod, still, still)}, {kB1, kB0, {}, {}}, kPeriod).travel.edges.empty());
}

}  // namespace
}  // namespace suspension_health_monitor
