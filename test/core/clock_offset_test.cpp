// Clocks that differ by more than a small part of the strut's period.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "hidden_effect.h"
#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/vehicle/rough_strut.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01, kNoise = 0.03;
constexpr int kFiner = 4;

/// The reference car, the body's clock late by so many quarters of a sample.
Drive lateBody(int quarters, int seed = 1) {
  SimulationOptions options = carDrive(60.0, 0.0, seed);
  options.rate = kFiner / kPeriod;
  const std::vector<DriveSample> fine = drive(options);
  RandomStream noise(seed, RandomPurpose::kSprungNoise);
  Drive result;
  for (int k = 100; k < static_cast<int>(fine.size()) - 100; k += kFiner)
    result.samples.push_back(
        {fromSeconds(kPeriod * k / kFiner),
         fine[static_cast<std::size_t>(k - quarters)].truth.sprung_acceleration + kNoise * noise.gaussian(),
         fine[static_cast<std::size_t>(k)].truth.unsprung_acceleration + kNoise * noise.gaussian()});
  return result;
}

TEST(ClockOffset, OffsetsUpTo50MsAreNamedWithTheirValue) {
  for (const int quarters : {-20, 6, 20}) {
    const double offset = quarters * kPeriod / kFiner;
    const Diagnosis found = diagnose({lateBody(quarters)});
    ASSERT_TRUE(found) << found.reason << ", offset " << offset;
    EXPECT_EQ(found.verdict, Verdict::kEffectFound) << offset;
    ASSERT_EQ(found.selected, std::vector<std::string>{"clock_offset"}) << offset;
    EXPECT_NEAR(found.model().reading.at(0).coefficients.at(0), offset, 1e-3);
    EXPECT_NEAR(found.model().stiffness_to_mass, 63.3, 1.0) << offset;
  }
}

TEST(ClockOffset, ClocksThatAgreeAndSensorsThatAreWrongShowNone) {
  const Drive right = lateBody(0);
  EXPECT_FALSE(roughStrut({right}, kPeriod).value().clocksDiffer(kPeriod));
  Drive swapped = right, turned = right, unrelated = right;
  const Drive other = lateBody(0, 2);
  for (std::size_t k = 0; k < right.samples.size(); ++k) {
    std::swap(swapped.samples[k].sprung_acceleration, swapped.samples[k].unsprung_acceleration);
    turned.samples[k].sprung_acceleration *= -1.0;
    unrelated.samples[k].sprung_acceleration = other.samples[k].sprung_acceleration;
  }
  for (const Drive* drive : {&swapped, &turned, &unrelated}) {
    const Diagnosis found = diagnose({*drive});
    EXPECT_TRUE(found.selected.empty());
  }
}

TEST(ClockOffset, IsKnownWithTheRoughStrut) {
  for (const int quarters : {-20, -12, -1, 1, 12, 20}) {
    const double offset = quarters * kPeriod / kFiner;
    const std::optional<RoughStrut> late = roughStrut({lateBody(quarters)}, kPeriod);
    ASSERT_TRUE(late) << offset;
    EXPECT_NEAR(late->clock_offset, offset, 1e-4);
    EXPECT_NEAR(late->strut.stiffness_to_mass, 63.3, 1.0) << offset;
    EXPECT_EQ(late->clocksDiffer(kPeriod), std::abs(quarters) > 1) << offset;  // by more than half a sample
  }
}

}  // namespace
}  // namespace suspension_health_monitor
