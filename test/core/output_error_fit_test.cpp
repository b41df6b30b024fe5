#include "suspension_health_monitor/internal/fit/output_error_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hidden_effect.h"
#include "recorded_drive.h"

namespace suspension_health_monitor {
namespace {

// The reference car: b1 = 6 1/s, b0 = 63.3 1/s^2.
const StrutModel kRough{6.6, 60.0, {}, {}};

StrutModel rough(const char* effect, double coefficient, std::vector<double> shapes) {
  StrutModel model = kRough;
  model.effects.push_back({findEffect(forceEffects(), effect), coefficient, std::move(shapes)});
  return model;
}

TEST(RunFree, IsTheSimulatorsBodyOnceTheStartIsForgotten) {
  const SimulationOptions options = carDrive(20.0, 0.0);
  const DriveRecord record = recorded(options);
  const std::vector<DriveSample> samples = drive(options);
  const DriveSegment& segment = record.segments().front();
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  ASSERT_TRUE(runFree({6.0, 63.3, {}, {}}, segment, {}, predicted, &motion));
  ASSERT_EQ(predicted.size(), segment.size());
  for (std::size_t k = 1000; k < segment.size(); ++k) {
    const DriveTruth& truth = samples[k + kInterpolationReach].truth;
    // The mean of w'' that the record takes off is missing in z'', and in d by b0.
    ASSERT_NEAR(predicted[k] + record.gravity(), truth.sprung_acceleration, 0.01);
    ASSERT_NEAR(motion[k].travel + record.gravity() / 63.3, truth.travel, 1e-4);
    ASSERT_NEAR(motion[k].travel_rate, truth.travel_rate, 1e-3);
  }
}

TEST(RunFree, AnUnstableModelRunsAway) {
  const DriveRecord record = recorded(carDrive(20.0, 0.0));
  std::vector<double> predicted;
  EXPECT_FALSE(runFree({-6.0, 63.3, {}, {}}, record.segments().front(), {}, predicted));
  EXPECT_FALSE(fitOutputError({&record}, {}, {-6.0, 63.3, {}, {}}));
}

TEST(FitOutputError, RecoversTheLinearStrutAndItsInitialState) {
  const SimulationOptions options = carDrive(60.0, 0.0);
  const DriveRecord record = recorded(options);
  const auto fit = fitOutputError({&record}, {}, kRough);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->model.damping_to_mass, 6.0, 0.002 * 6.0);
  EXPECT_NEAR(fit->model.stiffness_to_mass, 63.3, 0.002 * 63.3);
  const DriveTruth start = drive(options)[kInterpolationReach].truth;
  EXPECT_NEAR(fit->initial.at(0).travel, start.travel, 5e-4);
  EXPECT_NEAR(fit->initial.at(0).travel_rate, start.travel_rate, 5e-3);
  ASSERT_EQ(fit->stddev.size(), 2);
}

TEST(FitOutputError, RecoversCoefficientAndShape) {
  SimulationOptions options = carDrive(60.0, 0.0);
  const ActiveEffect stop = hiddenEffect(options, "bump_stop", {0.01}, 0.15);
  options.hidden = {stop};
  const DriveRecord record = recorded(options);
  const auto fit = fitOutputError({&record}, {}, rough("bump_stop", 0.0, {0.006}));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->model.damping_to_mass, 6.0, 0.01 * 6.0);
  EXPECT_NEAR(fit->model.stiffness_to_mass, 63.3, 0.01 * 63.3);
  EXPECT_NEAR(fit->model.effects[0].coefficient, stop.coefficient, 0.02 * stop.coefficient);
  EXPECT_NEAR(fit->model.effects[0].shapes[0], 0.01, 2e-4);
  ASSERT_EQ(fit->stddev.size(), 4);
}

TEST(FitOutputError, RecoversAReadingsScaleAndDelay) {
  SimulationOptions options = carDrive(60.0, 0.0);
  Drive record_drive;
  const std::vector<DriveSample> samples = drive(options);
  for (std::size_t k = 2; k < samples.size(); ++k)  // z'' is read two samples late and 10 % too large
    record_drive.samples.push_back(
        {samples[k].stamp, 1.1 * samples[k - 2].sprung->acceleration, samples[k].unsprung->acceleration});
  const DriveRecord record(record_drive, 0.01, 1);
  StrutModel start{6.0, 63.3, {}, {}};
  start.reading = {{measurementEffects()[0], {0.0}}, {measurementEffects()[2], {0.0}}};
  ASSERT_EQ(start.reading[0].effect.name + start.reading[1].effect.name, "clock_offsetscale_error");
  const auto fit = fitOutputError({&record}, {}, start);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->model.reading[0].coefficients[0], 0.02, 5e-4);
  EXPECT_NEAR(fit->model.reading[1].coefficients[0], 0.1, 0.01);
}

TEST(FitOutputError, SegmentsAndDrivesShareTheModelButNotTheirStarts) {
  const SimulationOptions options = carDrive(30.0, 0.0);
  const std::vector<DriveSample> samples = drive(options);
  Drive first_drive;
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (k != 1500)
      first_drive.samples.push_back(
          {samples[k].stamp, samples[k].sprung->acceleration, samples[k].unsprung->acceleration});
  const DriveRecord first(first_drive, 0.01, 1);
  const DriveRecord second = recorded(carDrive(30.0, 0.0, 2));
  const auto fit = fitOutputError({&first, &second}, {}, kRough);
  ASSERT_TRUE(fit);
  ASSERT_EQ(fit->initial.size(), 3u);
  ASSERT_EQ(fit->residuals.size(), 3u);
  EXPECT_EQ(fit->residuals[1].size(), first.segments()[1].size());
  EXPECT_EQ(fit->residuals[2].size(), second.segments()[0].size());
  EXPECT_NEAR(fit->model.stiffness_to_mass, 63.3, 0.005 * 63.3);
  const DriveTruth& middle = samples[1501 + kInterpolationReach].truth;
  EXPECT_NEAR(fit->initial[1].travel, middle.travel, 1e-3);
  EXPECT_NEAR(fit->initial[1].travel_rate, middle.travel_rate, 5e-3);
}

TEST(FitOutputError, ASegmentOfWhichNothingIsFittedDoesNotMatter) {
  const SimulationOptions options = carDrive(20.0, 0.03);
  Drive record_drive;
  for (const DriveSample& sample : drive(options))
    if (sample.stamp != std::chrono::seconds(15))
      record_drive.samples.push_back({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
  const DriveRecord record(record_drive, 0.01, 1);
  const std::vector<SampleMask> masks{SampleMask(record.segments().at(0).size(), 1),
                                      SampleMask(record.segments().at(1).size(), 0)};
  const auto fit = fitOutputError({&record}, masks, kRough);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->model.stiffness_to_mass, 63.3, 0.02 * 63.3);
  for (const double stddev : fit->stddev) EXPECT_TRUE(std::isfinite(stddev) && stddev > 0.0);
}

TEST(FitOutputError, OutliersHardlyMoveTheResult) {
  const SimulationOptions options = carDrive(30.0, 0.03);
  Drive record_drive;
  int k = 0;
  for (const DriveSample& sample : drive(options))
    record_drive.samples.push_back(
        {sample.stamp, sample.sprung->acceleration + (++k % 50 == 0 ? 20.0 : 0.0), sample.unsprung->acceleration});
  const DriveRecord record(record_drive, 0.01, 1);
  const auto fit = fitOutputError({&record}, {}, kRough);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->model.damping_to_mass, 6.0, 0.02 * 6.0);
  EXPECT_NEAR(fit->model.stiffness_to_mass, 63.3, 0.02 * 63.3);
}

TEST(FitOutputError, StandardDeviationsCoverTheTruth) {
  constexpr int runs = 24;
  int inside[2] = {0, 0};  // within one standard deviation of b1 and b0
  double square[2] = {0.0, 0.0};
  for (int seed = 1; seed <= runs; ++seed) {
    SimulationOptions options = carDrive(20.0, 0.0, seed);
    options.noise = 0.0;
    const std::vector<DriveSample> clean = drive(options);
    options.noise = 0.1;
    const std::vector<DriveSample> noisy = drive(options);
    Drive record_drive;  // noise on z'' only: that on w'' is not in an output-error fit's account
    for (std::size_t k = 0; k < clean.size(); ++k)
      record_drive.samples.push_back({clean[k].stamp, noisy[k].sprung->acceleration, clean[k].unsprung->acceleration});
    const DriveRecord record(record_drive, 0.01, 1);
    const auto fit = fitOutputError({&record}, {}, kRough);
    ASSERT_TRUE(fit);
    const double errors[] = {fit->model.damping_to_mass - 6.0, fit->model.stiffness_to_mass - 63.3};
    for (int i = 0; i < 2; ++i) {
      const double t = errors[i] / fit->stddev[i];
      square[i] += t * t;
      inside[i] += std::abs(t) < 1.0;
    }
  }
  for (int i = 0; i < 2; ++i) {
    // Binomial, n = 24, p = 0.683: mean 16.4, standard deviation 2.3; three of them.
    EXPECT_GE(inside[i], 10) << i;
    EXPECT_LE(inside[i], 23) << i;
    // Chi square of 24 at its 0.1 % ends: 8.1 and 51.2.
    EXPECT_GT(square[i], 8.1) << i;
    EXPECT_LT(square[i], 51.2) << i;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
