#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/health/health_rules.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSharp = 1e-4;  // standard deviation so small that nothing counts as noise

StrutChange split(double damping, double stiffness, double mass, double range = 0.35, double stddev = kSharp) {
  return splitChange({Measured{std::log(damping / mass), stddev}, Measured{std::log(stiffness / mass), stddev}}, range,
                     0.0);
}

TEST(SplitChange, TellsPayloadFromDamage) {
  for (const double mass : {0.8, 1.0, 1.3})
    for (const auto& [damping, stiffness] : {std::pair(1.0, 1.0), std::pair(0.7, 1.0), std::pair(1.0, 0.7)}) {
      if (mass < 1.0 && damping * stiffness < 1.0) continue;  // less load hides a loss: see the next test
      const StrutChange change = split(damping, stiffness, mass);
      EXPECT_NEAR(*change.damping, damping - 1.0, 1e-5) << mass;
      EXPECT_NEAR(*change.stiffness, stiffness - 1.0, 1e-5) << mass;
      EXPECT_NEAR(*change.payload, mass - 1.0, 1e-5) << mass;
    }
}

TEST(SplitChange, TakesNoPayloadWhereTheParametersMoveApart) {
  const StrutChange change = split(0.8, 1.1, 1.0);
  EXPECT_NEAR(*change.damping, -0.2, 1e-12);
  EXPECT_NEAR(*change.stiffness, 0.1, 1e-12);
  EXPECT_EQ(*change.payload, 0.0);
}

TEST(SplitChange, WhatIsBeyondThePayloadRangeIsDamage) {
  const StrutChange change = split(1.0, 1.0, 1.5, 0.2);
  EXPECT_NEAR(*change.payload, 0.2, 1e-12);
  EXPECT_NEAR(*change.damping, 1.2 / 1.5 - 1.0, 1e-12);
  EXPECT_NEAR(*change.stiffness, 1.2 / 1.5 - 1.0, 1e-12);
  EXPECT_NEAR(*split(0.7, 0.7, 1.0, 0.0).damping, -0.3, 1e-12);
}

TEST(SplitChange, ADamageIsAsCertainAsItIsThatNoLoadDidIt) {
  const StrutChange unloaded = splitChange({Measured{-0.2, 0.01}, Measured{0.0, 0.02}}, 0.35, 0.0);
  EXPECT_NEAR(std::log1p(*unloaded.damping), -0.2, 1e-12);
  EXPECT_NEAR(unloaded.damping_stddev, 0.01, 1e-12);  // the noise of stiffness does not enter the size
  EXPECT_NEAR(*unloaded.distance_from_load, 0.2 / std::hypot(0.01, 0.02), 1e-9);
  // No load of the range takes more than ln(1.35) = 0.3 away: the rest is as certain as the damping is.
  const StrutChange beyond = splitChange({Measured{-0.7, 0.01}, Measured{0.0, 0.5}}, 0.35, 0.0);
  EXPECT_GT(*beyond.distance_from_load, 0.39 / 0.01);
  const StrutChange loaded = splitChange({Measured{-0.2, 0.01}, Measured{-0.1, 0.02}}, 0.35, 0.0);
  EXPECT_NEAR(loaded.damping_stddev, std::hypot(0.01, 0.02), 1e-12);
  EXPECT_NEAR(std::log1p(*loaded.payload), 0.1 * (1.0 - 0.16), 1e-12);  // (2 * 0.02 / 0.1)^2
  const StrutChange alone = splitChange({Measured{-0.2, 0.01}, std::nullopt}, 0.35, 0.0);
  EXPECT_FALSE(alone.payload);
  EXPECT_EQ(alone.damping_stddev, 0.01);
  EXPECT_FALSE(split(0.8, 1.0, 1.0, 0.0).distance_from_load);  // none may be
}

// -30 % of mass, then -30 % of damping: damping alone would look as if nothing had happened to it, and the spring
// stiffer.
TEST(SplitChange, CountsTheLoadFromTheOneThatWasThere) {
  const Measured damping{std::log(0.7 / 0.7), kSharp}, stiffness{std::log(1.0 / 0.7), kSharp};
  const StrutChange change = splitChange({damping, stiffness}, 0.35, std::log(0.7));
  EXPECT_NEAR(*change.damping, -0.3, 1e-9);
  EXPECT_NEAR(*change.stiffness, 0.0, 1e-9);
  EXPECT_NEAR(*change.payload, -0.3, 1e-9);
  EXPECT_NEAR(*splitChange({damping, stiffness}, 0.35, 0.0).stiffness, 1.0 / 0.7 - 1.0, 1e-9);
}

TEST(DistanceFromLoad, IsThatOfTheWeightedMeanWithinItsRange) {
  const auto distance = [](double damping, double stiffness, double stddev) {
    return distanceFromLoad({Measured{damping, 0.01}, Measured{stiffness, stddev}}, {-0.4, 0.3});
  };
  EXPECT_NEAR(distance(-0.2, -0.1, 0.02), 0.1 / std::hypot(0.01, 0.02), 1e-9);  // of two values from their common mean
  EXPECT_NEAR(distance(-0.7, -0.5, 0.01), std::hypot(0.4, 0.2) / 0.01, 1e-9);   // from the heaviest
  EXPECT_NEAR(distance(0.7, 0.5, 0.01), std::hypot(0.3, 0.1) / 0.01, 1e-9);     // from the lightest
}

// Errors that both share are no distance: of x1 - x0, which no load moves, the variance is d^2 + s^2 - 2 c d s.
TEST(DistanceFromLoad, KnowsThatErrorsOfBothAreCorrelated) {
  constexpr double kDamping = 0.03, kStiffness = 0.01;
  for (const double correlation : {-0.8, 0.0, 0.8}) {
    const MeasuredChange both{Measured{-0.2, kDamping}, Measured{-0.1, kStiffness}, correlation};
    const double apart =
        std::sqrt(kDamping * kDamping + kStiffness * kStiffness - 2.0 * correlation * kDamping * kStiffness);
    EXPECT_NEAR(distanceFromLoad(both, {-0.4, 0.4}), 0.1 / apart, 1e-9) << correlation;
    EXPECT_NEAR(splitChange(both, 0.35, 0.0).apartStddev(), apart, 1e-12) << correlation;
  }
}

// The mean time between false alarms of a healthy strut is at least the one that was asked for (Lorden's bound),
// whatever the noise against the reference; 400 alarms know their mean to 5 %.
TEST(EarlyWarning, HasNoMoreFalseAlarmsThanWereAskedFor) {
  constexpr double kWanted = 100.0;
  for (const double stddev : {0.02, 0.05, 0.15}) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, stddev);
    double values = 0.0;
    for (int alarm = 0; alarm < 400; ++alarm) {
      EarlyWarning warning(0.03, kWanted);
      do values += 1.0;
      while (!warning.add(noise(random), stddev));
    }
    EXPECT_GT(values / 400, kWanted) << stddev;
    EXPECT_LT(values / 400, 100.0 * kWanted) << stddev;
  }
}

TEST(EarlyWarning, ProvesASmallChangeOfEitherSignAndEndsWithIt) {
  for (const double sign : {-1.0, 1.0}) {
    EarlyWarning warning(0.03, 1e5);
    for (int k = 0; k < 100; ++k) ASSERT_FALSE(warning.add(sign * 0.02, 0.01));
    int needed = 0;
    while (!warning.add(sign * 0.07, 0.01) && needed < 100) ++needed;
    EXPECT_EQ(needed, static_cast<int>(std::ceil(std::log(2e5) / (2.0 * 0.03 * 0.04 / 1e-4))) - 1);
    for (int k = 0; k < 100; ++k) warning.add(0.0, 0.01);
    EXPECT_FALSE(warning.isOn());
  }
}

TEST(EarlyWarning, SaysNothingOfValuesWhoseUncertaintyIsNotKnown) {
  EarlyWarning warning(0.03, 1e5);
  for (int k = 0; k < 1000; ++k) ASSERT_FALSE(warning.add(-0.5, std::nan("")));
}

StrutEstimate estimate(double b1, double b0) {
  StrutEstimate result;
  result.damping_to_mass = b1;
  result.stiffness_to_mass = b0;
  result.damping_to_mass_stddev = 0.02;
  result.stiffness_to_mass_stddev = 0.1;
  result.window = 4.0;
  result.doubt = EstimateDoubt::kNone;
  return result;
}

// Windows that overlap: of 100 s there are 25 that share no reading.
TEST(BaselineLearner, IsTheMeanOfTheStretchWithItsUncertainty) {
  BaselineLearner learner(100.0);
  std::optional<Baseline> learned;
  int calls = 0;
  for (; !learned; ++calls) {
    EXPECT_NEAR(learner.progress(), calls / 100.0, 1e-9);
    learned = learner.add(fromSeconds(5.0 + calls), estimate(calls % 2 ? 3.02 : 2.98, 13.8), 1.0);
  }
  EXPECT_EQ(calls, 100);
  EXPECT_NEAR(*learned->damping_to_mass, 3.0, 1e-9);
  EXPECT_NEAR(*learned->stiffness_to_mass, 13.8, 1e-9);
  EXPECT_NEAR(learned->damping_to_mass_stddev, 0.02 / 5.0, 1e-9);
  EXPECT_NEAR(learned->stiffness_to_mass_stddev, 0.1 / 5.0, 1e-9);
  EXPECT_TRUE(learned->learned);
  EXPECT_EQ(learned->from, fromSeconds(4.0));  // where the first second begins
  EXPECT_EQ(learned->to, fromSeconds(104.0));
}

TEST(BaselineLearner, OfLessThanAWindowIsNoSurerThanAnEstimate) {
  BaselineLearner learner(2.0);
  learner.add(fromSeconds(1.0), estimate(3.0, 13.8), 1.0);
  const std::optional<Baseline> learned = learner.add(fromSeconds(2.0), estimate(3.0, 13.8), 1.0);
  ASSERT_TRUE(learned);
  EXPECT_NEAR(learned->damping_to_mass_stddev, 0.02, 1e-12);
}

// Values that alternate by 0.06 either way have a variance of 0.06^2, of which 0.02^2 is their own. 25 windows tell it:
// Student's distribution has 25 / 23 of it.
TEST(BaselineLearner, KnowsByHowMuchHealthyWindowsScatter) {
  BaselineLearner learner(100.0);
  std::optional<Baseline> learned;
  for (int k = 0; !learned; ++k) learned = learner.add(fromSeconds(5.0 + k), estimate(k % 2 ? 3.06 : 2.94, 13.8), 1.0);
  const double scatter = std::sqrt(0.06 * 0.06 * 25.0 / 23.0 - 0.02 * 0.02);
  EXPECT_NEAR(learned->damping_scatter, scatter, 0.02 * scatter);
  EXPECT_EQ(learned->stiffness_scatter, 0.0);
  EXPECT_NEAR(learned->damping_to_mass_stddev, 0.06 / 5.0, 0.05 * 0.06 / 5.0);
  const MeasuredChange changed = changeFrom(*learned, estimate(3.0, 13.8));
  ASSERT_TRUE(changed.damping);
  EXPECT_NEAR(changed.damping->stddev, std::hypot(scatter, 0.02, 0.06 / 5.0) / 3.0, 0.02 * scatter / 3.0);
}

// Each half is steady, and they are too near to each other for a drift: the road between them has changed.
TEST(BaselineLearner, TakesTheDifferenceOfItsHalvesAsScatter) {
  BaselineLearner learner(12.0);
  std::optional<Baseline> learned;
  for (int k = 0; !learned; ++k) learned = learner.add(fromSeconds(5.0 + k), estimate(k < 6 ? 3.0 : 3.08, 13.8), 1.0);
  EXPECT_NEAR(*learned->damping_to_mass, 3.04, 1e-9);
  EXPECT_NEAR(learned->damping_scatter, std::sqrt(0.04 * 0.04 * 3.0 - 0.02 * 0.02), 1e-9);  // of three windows
}

TEST(BaselineLearner, TakesNoTwoDrivesForOne) {
  BaselineLearner learner(100.0);
  for (int k = 0; k < 75; ++k) ASSERT_FALSE(learner.add(fromSeconds(k), estimate(3.0, 13.8), 1.0));
  std::optional<Baseline> learned;
  for (int k = 25; !learned; ++k) learned = learner.add(fromSeconds(k), estimate(2.0, 20.0), 1.0);
  EXPECT_NEAR(*learned->damping_to_mass, 2.0, 1e-9);
  EXPECT_EQ(learned->from, fromSeconds(24.0));
  EXPECT_EQ(learned->to, fromSeconds(124.0));
}

TEST(BaselineLearner, DoesNotTakeAChangingStrutAsHealthy) {
  for (const bool stiffness : {false, true}) {
    BaselineLearner learner(100.0);
    for (int k = 0; k < 100; ++k) {
      const double share = 1.0 - 0.2 * k / 100.0;
      ASSERT_FALSE(
          learner.add(fromSeconds(k), stiffness ? estimate(3.0, 13.8 * share) : estimate(3.0 * share, 13.8), 1.0));
    }
    EXPECT_EQ(learner.restarts(), 1);
    EXPECT_EQ(learner.progress(), 0.0);
  }
}

// A damper that loses 0.3 % per kelvin.
StrutEstimate warmEstimate(double celsius, double noise = 0.0) {
  StrutEstimate result = estimate(3.0 * std::exp(-0.003 * (celsius - 20.0)) + noise, 13.8);
  result.temperature = celsius;
  return result;
}

// It warms from 20 to 50 degrees C. 600 s have 150 windows of 4 s that share no reading, so a half's ln b1 is known to
// 0.02 / 3 / sqrt(75) = 0.08 %, the difference of both over 15 K to 0.007 % per kelvin.
TEST(BaselineLearner, LearnsHowDampingGoesWithTheTemperature) {
  BaselineLearner learner(600.0);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.02);
  std::optional<Baseline> learned;
  for (int k = 0; !learned && k < 600; ++k)
    learned = learner.add(fromSeconds(k), warmEstimate(20.0 + 0.05 * k, noise(random)), 1.0);
  ASSERT_TRUE(learned && learned->temperature);
  EXPECT_NEAR(learned->temperature->celsius, 35.0, 0.1);
  EXPECT_NEAR(learned->temperature->per_kelvin, -0.003, 3.0 * learned->temperature->per_kelvin_stddev);
  EXPECT_LT(learned->temperature->per_kelvin_stddev, 0.0003);
  for (const double celsius : {-10.0, 80.0}) {
    StrutEstimate now = warmEstimate(celsius);
    const Measured healthy = *changeFrom(*learned, now).damping;
    EXPECT_NEAR(healthy.value, 0.0, 3.0 * healthy.stddev) << celsius;
    EXPECT_LT(healthy.stddev, 0.03) << celsius;
    now.damping_to_mass *= 0.7;
    EXPECT_NEAR(changeFrom(*learned, now).damping->value, std::log(0.7), 3.0 * healthy.stddev) << celsius;
  }
}

TEST(BaselineLearner, OfOneTemperatureDoesNotKnowWhatAnotherOneDoes) {
  BaselineLearner learner(100.0);
  std::optional<Baseline> learned;
  for (int k = 0; !learned; ++k) learned = learner.add(fromSeconds(k), warmEstimate(20.0), 1.0);
  const Measured warm = *changeFrom(*learned, warmEstimate(60.0)).damping;
  EXPECT_NEAR(warm.stddev, 40.0 * DamperTemperature::kPriorStddev, 0.01);
  EXPECT_NEAR(warm.value, -0.003 * 40.0, 1e-6);
  EXPECT_LT(changeFrom(*learned, warmEstimate(20.0)).damping->stddev, 0.01);
  StrutEstimate without = warmEstimate(20.0);
  without.temperature.reset();
  EXPECT_LT(changeFrom(*learned, without).damping->stddev, 0.01);
}

}  // namespace
}  // namespace suspension_health_monitor
