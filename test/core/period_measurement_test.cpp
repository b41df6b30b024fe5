#include "suspension_health_monitor/internal/signal/period_measurement.h"

#include <gtest/gtest.h>

#include <random>

namespace suspension_health_monitor {
namespace {

Stamp at(double seconds) { return fromSeconds(seconds); }

void addBoth(PeriodMeasurement& measurement, Stamp stamp) {
  measurement.add(Side::kSprung, stamp);
  measurement.add(Side::kUnsprung, stamp);
}

TEST(PeriodMeasurement, GivesNothingBeforeBothStreamsHaveShownEnoughSpacings) {
  PeriodMeasurement measurement(3);
  for (int k = 0; k < 10; ++k) measurement.add(Side::kSprung, at(0.02 * k));
  EXPECT_FALSE(measurement.period());
  for (int k = 0; k < 3; ++k) measurement.add(Side::kUnsprung, at(0.02 * k));
  EXPECT_FALSE(measurement.period());
  measurement.add(Side::kUnsprung, at(0.06));
  EXPECT_NEAR(*measurement.period(), 0.02, 1e-9);
}

TEST(PeriodMeasurement, IsThatOfTheSlowerStream) {
  for (const auto& [body, wheel] : {std::pair(0.01, 0.04), std::pair(0.04, 0.01)}) {
    PeriodMeasurement measurement(20);
    for (int k = 0; k < 30; ++k) {
      measurement.add(Side::kSprung, at(body * k));
      measurement.add(Side::kUnsprung, at(wheel * k));
    }
    EXPECT_NEAR(*measurement.period(), 0.04, 1e-9);
  }
}

TEST(PeriodMeasurement, PassesOverGapsRepeatedStampsAndClocksThatJump) {
  PeriodMeasurement measurement(50);
  double t = 1.7e9;
  for (int k = 0; k < 101; ++k) {
    addBoth(measurement, at(t));
    t += k % 10 == 3 ? 0.5 : k % 10 == 5 ? -7.0 : k % 10 == 7 ? 0.0 : 0.02;
  }
  EXPECT_NEAR(*measurement.period(), 0.02, 1e-6);
}

// Stamps are late by up to J = 40 % of a period. The spacings add up to the time between the first and the last stamp,
// so that their mean is wrong by J / n at most: 0.4 % of T for n = 100.
TEST(PeriodMeasurement, TakesTheJitterOfManyStampsDown) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> late(0.0, 0.4 * 0.02);
  PeriodMeasurement measurement(100);
  for (int k = 0; k < 101; ++k) {
    measurement.add(Side::kSprung, at(0.02 * k + late(engine)));
    measurement.add(Side::kUnsprung, at(0.02 * k + late(engine)));
  }
  EXPECT_NEAR(*measurement.period(), 0.02, 0.004 * 0.02);
}

TEST(PeriodMeasurement, OfManyStreamsIsThatOfTheSlowestOneThatIsRequired) {
  PeriodMeasurement measurement(20, {false, true, true, true});
  for (int k = 0; k < 30; ++k) {
    measurement.add(std::size_t{0}, at(0.05 * k));
    for (std::size_t i = 1; i < 4; ++i) {
      EXPECT_EQ(measurement.period().has_value(), k > 20 || (k == 20 && i == 4)) << k;
      measurement.add(i, at((i == 2 ? 0.02 : 0.01) * k));
    }
  }
  EXPECT_NEAR(*measurement.period(), 0.02, 1e-12);
}

TEST(PeriodMeasurement, TellsOfAStampThatStandsStill) {
  PeriodMeasurement measurement(2);
  EXPECT_FALSE(measurement.add(Side::kSprung, at(0.0)));
  EXPECT_TRUE(measurement.add(Side::kSprung, at(0.0)));
  EXPECT_FALSE(measurement.add(Side::kUnsprung, at(0.0)));  // every stream has its own stamp before
}

}  // namespace
}  // namespace suspension_health_monitor
