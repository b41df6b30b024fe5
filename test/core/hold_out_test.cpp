#include "suspension_health_monitor/internal/fit/hold_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "hidden_effect.h"
#include "quarter_car.h"
#include "recorded_drive.h"
#include "simulated_drive.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;
constexpr int kEnd = kInterpolationReach;
const double kHalfSecond = std::pow(2.0 * M_PI / 0.5, 2);  // b0 of a natural period of 50 samples

// 1500 usable samples: fifteen blocks of 100, of which 2, 5, 8, 11, 14 are held out; z'' is 1 in every second sample.
DriveRecord blocks() {
  return recorded(
      1500 + 2 * kEnd, kPeriod, [](int k) { return (k - kEnd) % 2 + 0.0; },
      [](int k) { return std::sin(0.2 * M_PI * k); });
}

std::vector<std::vector<double>> unitResidualAt(std::size_t k) {
  std::vector<std::vector<double>> residuals{std::vector<double>(1500, 0.0)};
  residuals[0][k] = 2.0;
  return residuals;
}

TEST(TestPaired, IsAsWorkedByHand) {
  // Differences 1, 2, 0, 1: mean 1, variance 2/3.
  const PairedTest result = testPaired({4.0, 6.0, 8.0, 2.0}, {3.0, 4.0, 8.0, 1.0}, 4.0);
  EXPECT_NEAR(result.removed_share, 0.2, 1e-12);
  EXPECT_NEAR(result.t, 1.0 / std::sqrt(2.0 / 3.0 / 4.0), 1e-12);
  EXPECT_NEAR(result.log_ratio, 4.0 * std::log(20.0 / 16.0), 1e-12);
  const PairedTest worse = testPaired({3.0, 4.0, 8.0, 1.0}, {4.0, 6.0, 8.0, 2.0}, 4.0);
  EXPECT_NEAR(worse.removed_share, -0.25, 1e-12);
  EXPECT_LT(worse.t, -2.4);
  EXPECT_LT(worse.log_ratio, 0.0);
}

TEST(IsSignificant, UsesTheQuantilesOfBothStatistics) {
  EXPECT_TRUE(isSignificant({0.1, 2.33, 0.0}, 0.01));  // normal: 2.326
  EXPECT_FALSE(isSignificant({0.1, 2.32, 0.0}, 0.01));
  EXPECT_FALSE(isSignificant({0.1, -9.0, 0.0}, 0.01));
  EXPECT_TRUE(isSignificant({0.1, 0.0, 9.22}, 0.01));  // chi square of 2: -2 ln 0.01 = 9.210
  EXPECT_FALSE(isSignificant({0.1, 0.0, 9.20}, 0.01));
}

TEST(HoldOut, EveryThirdBlockIsHeldOut) {
  const DriveRecord record = blocks();
  const auto held_out = splitHoldOut({&record}, kHalfSecond);
  ASSERT_TRUE(held_out);
  const SampleMask& mask = held_out->training.at(0);
  ASSERT_EQ(mask.size(), 1500u);
  for (std::size_t k = 0; k < mask.size(); ++k) ASSERT_EQ(mask[k] != 0, k / 100 % 3 != 2) << k;
}

TEST(HoldOut, StretchesLastOneNaturalPeriodAndHoldTheirOwnSamples) {
  const DriveRecord record = blocks();
  const auto held_out = splitHoldOut({&record}, kHalfSecond);
  const auto errorsAt = [&](std::size_t k) { return held_out->stretchLosses(unitResidualAt(k)); };
  ASSERT_EQ(errorsAt(0).size(), 10u);
  EXPECT_EQ(errorsAt(200)[0], 4.0);
  EXPECT_EQ(errorsAt(249)[0], 4.0);
  EXPECT_EQ(errorsAt(250)[1], 4.0);
  EXPECT_EQ(errorsAt(299)[1], 4.0);
  EXPECT_EQ(errorsAt(500)[2], 4.0);
  EXPECT_EQ(errorsAt(1499)[9], 4.0);
}

TEST(HoldOut, EverySampleIsEitherTrainedOnOrJudgedBy) {
  const DriveRecord record = blocks();
  const auto held_out = splitHoldOut({&record}, kHalfSecond);
  for (const std::size_t k : {0u, 199u, 200u, 299u, 300u, 1399u, 1400u, 1499u}) {
    const std::vector<double> errors = held_out->stretchLosses(unitResidualAt(k));
    const bool judged = k / 100 % 3 == 2;
    EXPECT_EQ(std::accumulate(errors.begin(), errors.end(), 0.0), judged ? 4.0 : 0.0) << k;
    EXPECT_EQ(held_out->trainingError(unitResidualAt(k)), judged ? 0.0 : 4.0) << k;
  }
}

TEST(HoldOut, RmseIsPerHeldOutSampleAndFitPercentAgainstTheirDeviation) {
  const DriveRecord record = blocks();
  const auto held_out = splitHoldOut({&record}, kHalfSecond);
  EXPECT_NEAR(held_out->rmse(unitResidualAt(250)), std::sqrt(4.0 / 500.0), 1e-12);
  EXPECT_NEAR(held_out->fitPercent(0.1), 80.0, 1e-9);  // 0 and 1 in turns: deviation 0.5
}

TEST(HoldOut, SegmentsOfSeveralDrivesAreNumberedThrough) {
  const DriveRecord first = blocks(), second = blocks();
  const auto held_out = splitHoldOut({&first, &second}, kHalfSecond);
  ASSERT_EQ(held_out->training.size(), 2u);
  std::vector<std::vector<double>> residuals(2, std::vector<double>(1500, 0.0));
  residuals[1][200] = 2.0;
  const std::vector<double> errors = held_out->stretchLosses(residuals);
  ASSERT_EQ(errors.size(), 20u);
  EXPECT_EQ(errors[10], 4.0);
  residuals[1][200] = 0.0;
  residuals[1][300] = 3.0;
  EXPECT_EQ(held_out->trainingError(residuals), 9.0);
}

TEST(HoldOut, LossesAreSquaresForSmallResidualsAndGrowLinearlyForLargeOnes) {
  const DriveRecord record = blocks();
  const auto held_out = splitHoldOut({&record}, kHalfSecond);
  EXPECT_NEAR(held_out->stretchLosses(unitResidualAt(250), 1e4)[1], 4.0, 1e-6);
  EXPECT_NEAR(held_out->stretchLosses(unitResidualAt(250), 2.0)[1], 8.0 * (std::sqrt(2.0) - 1.0), 1e-12);
  EXPECT_NEAR(held_out->stretchLosses(unitResidualAt(250), 1e-6)[1], 4e-6, 1e-11);
  EXPECT_EQ(held_out->stretchLosses(unitResidualAt(250), 2.0)[0], 0.0);
}

TEST(HoldOut, ColouredResidualsAreWorthFewerIndependentSquares) {
  const DriveRecord record = blocks();
  const auto held_out = splitHoldOut({&record}, kHalfSecond);
  RandomStream random(3, RandomPurpose::kSprungNoise);
  std::vector<std::vector<double>> white(1), sums(1);
  double last = 0.0;
  for (int k = 0; k < 1500; ++k) {
    white[0].push_back(random.gaussian());
    sums[0].push_back(white[0].back() + last);
    last = white[0].back();
  }
  // 500 held-out samples and 49 lags whose estimated rho^2 is 1/500 on average: 500 / (1 + 2 * 49 / 500) = 418. Of sums
  // of two neighbours rho is 1/2 at lag 1: 500 / (1 + 2 / 4 + ...), and the others' variance grows to 1.5 / 500.
  EXPECT_NEAR(held_out->independentSquares(white), 418.0, 30.0);
  EXPECT_NEAR(held_out->independentSquares(sums), 500.0 / (1.5 + 2.0 * 48.0 * 1.5 / 500.0), 30.0);
}

TEST(HoldOut, TooShortADriveCannotBeSplit) {
  const DriveRecord record = blocks();
  EXPECT_FALSE(splitHoldOut({&record}, std::pow(2.0 * M_PI / 1.0, 2)));  // 5 stretches of 1 s
}

TEST(HoldOut, WhatIsHeldOutDoesNotReachTheFit) {
  SimulationOptions options = scenario("iso_road", 20.0);
  options.rate = 100.0;
  options.damping_end_fraction = 1.0;
  const DriveRecord truth = recorded(options);
  const auto held_out = splitHoldOut({&truth}, 63.3);
  ASSERT_TRUE(held_out);
  const SampleMask& mask = held_out->training[0];
  Drive spoilt_drive;
  for (const DriveSample& sample : drive(options)) {
    const auto k = static_cast<std::size_t>(std::lround(toSeconds(sample.stamp) * options.rate)) - kEnd;
    const bool hidden = k < mask.size() && mask[k] == 0;
    spoilt_drive.samples.push_back(
        {sample.stamp, sample.sprung->acceleration + (hidden ? 1.0 : 0.0), sample.unsprung->acceleration});
  }
  const DriveRecord spoilt(spoilt_drive, 1.0 / options.rate, 1);
  const StrutModel start{5.0, 70.0, {}, {}};
  const auto fit = fitOutputError({&truth}, held_out->training, start);
  const auto again = fitOutputError({&spoilt}, held_out->training, start);
  ASSERT_TRUE(fit && again);
  EXPECT_EQ(fit->model.damping_to_mass, again->model.damping_to_mass);
  EXPECT_EQ(fit->model.stiffness_to_mass, again->model.stiffness_to_mass);
  const auto unmasked = fitOutputError({&spoilt}, {}, start);
  ASSERT_TRUE(unmasked);
  EXPECT_NE(fit->model.stiffness_to_mass, unmasked->model.stiffness_to_mass);
}

TEST(EstimateNoiseFloor, IsAboutWhatTheTrueModelLeaves) {
  for (const char* vehicle : {"paper", "golden_car"}) {
    SimulationOptions options = scenario("iso_road", 120.0);
    options.vehicle = vehicle;
    options.rate = 100.0;
    options.noise = 0.05;
    options.gaussian_noise = true;
    options.damping_end_fraction = 1.0;
    const DriveRecord record = recorded(options);
    const QuarterCar car = carOf(options);
    const StrutModel truth{car.dampingToMass(), car.stiffnessToMass(), {}, {}};
    std::vector<double> predicted;
    const DriveSegment& segment = record.segments().front();
    ASSERT_TRUE(runFree(truth, segment, {}, predicted));
    double square = 0.0;
    constexpr std::size_t settled = 500;
    for (std::size_t k = settled; k < predicted.size(); ++k) square += std::pow(segment.sprung[k] - predicted[k], 2);
    const double left = std::sqrt(square / static_cast<double>(predicted.size() - settled));
    // An interpolation that sees noisy samples only leaves a little more than the noise.
    const double floor = estimateNoiseFloor({&record}, truth);
    EXPECT_GT(floor, 0.97 * left) << vehicle;
    EXPECT_LT(floor, 1.06 * left) << vehicle;
  }
}

// A linear model leaves a force that has a kink at every turn of the wheel; it is no noise.
TEST(EstimateNoiseFloor, ForcesThatChangeWithinAFewSamplesAreNoNoise) {
  constexpr double noise = 0.03, b1 = 6.0, b0 = 63.3;
  const double left = noise * std::sqrt(1.0 + 0.01 * (b1 * b1 + b0) / (2.0 * b1));  // w'' has noise, too
  for (const char* effect : {"asymmetric_damping", "quadratic_damping", "damping_drift"}) {
    SimulationOptions options = carDrive(120.0, noise);
    options.hidden = {hiddenEffect(options, effect, {}, 0.15)};
    const DriveRecord record = recorded(options);
    const auto fit = fitOutputError({&record}, {}, {b1, b0, {}, {}});
    ASSERT_TRUE(fit);
    const double floor = estimateNoiseFloor({&record}, fit->model);
    EXPECT_GT(floor, 0.97 * left) << effect;
    EXPECT_LT(floor, 1.15 * left) << effect;  // 1.3 to 1.7 without the free-form laws
  }
}

}  // namespace
}  // namespace suspension_health_monitor
