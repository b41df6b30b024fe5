#include "suspension_health_monitor/internal/identification/horizon_survey.h"

#include <gtest/gtest.h>

#include <random>

#include "paper_drive.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"

namespace suspension_health_monitor {
namespace {

SimulationOptions roadDrive() {
  SimulationOptions options;
  options.scenario = "iso_road";
  options.vehicle = "golden_car";
  options.rate = 200.0;
  options.noise = 0.1;
  options.duration = 30.0;
  return options;
}

TEST(HorizonSurvey, FindsTheHorizonThatTheTrueParametersAskFor) {
  const SimulationOptions drive = roadDrive();
  const int expected =
      horizonSamples(proposeHorizon(6.0, 63.3).horizon, 1.0 / drive.rate);
  HorizonSurvey survey(1.0 / drive.rate, IntegrationRule::kBandLimited, 400);
  for (const CornerSample& sample : simulate(drive)) survey.push(sample);
  ASSERT_TRUE(survey.horizonSamples());
  EXPECT_NEAR(*survey.horizonSamples(), expected, 0.1 * expected);
}

TEST(HorizonSurvey, DoesNotDependOnTheUnitOfTheSensors) {
  const SimulationOptions drive = roadDrive();
  HorizonSurvey survey(1.0 / drive.rate, IntegrationRule::kBandLimited, 400), in_volts(survey);
  for (const CornerSample& sample : simulate(drive)) {
    survey.push(sample);
    in_volts.push({sample.stamp, 1e-3 * sample.sprung_acceleration, 1e-3 * sample.unsprung_acceleration});
  }
  EXPECT_EQ(in_volts.horizonSamples(), survey.horizonSamples());
}

TEST(HorizonSurvey, KeepsWhatItLearntOverAnInterruption) {
  HorizonSurvey survey(0.02, IntegrationRule::kBandLimited, 100), interrupted(survey);
  const std::vector<CornerSample> drive = healthyPaperDrive(60.0, 0.024);
  for (const CornerSample& sample : drive) survey.push(sample);
  for (const CornerSample& sample : drive) interrupted.push(sample);
  interrupted.interrupt();
  EXPECT_EQ(interrupted.horizonSamples(), survey.horizonSamples());
  for (const CornerSample& sample : drive) interrupted.push(sample);
  EXPECT_NEAR(*interrupted.horizonSamples(), *survey.horizonSamples(), 2);
}

TEST(HorizonSurvey, GivesNothingBeforeItHasSeenAStrut) {
  HorizonSurvey survey(0.02, IntegrationRule::kBandLimited, 100);
  EXPECT_FALSE(survey.horizonSamples());
  for (int k = 0; k < 1000; ++k) survey.push({k * std::chrono::milliseconds(20), 9.81, 9.81});  // parked
  EXPECT_FALSE(survey.horizonSamples());
}

TEST(HorizonSurvey, IsClearOnAStrutWhoseHorizonIsAmongThoseTried) {
  HorizonSurvey survey(0.005, IntegrationRule::kBandLimited, 400), too_short(0.005, IntegrationRule::kBandLimited, 10);
  EXPECT_FALSE(survey.isClear());
  for (const CornerSample& sample : simulate(roadDrive())) {
    survey.push(sample);
    too_short.push(sample);
  }
  EXPECT_TRUE(survey.isClear());
  EXPECT_FALSE(too_short.isClear());
}

// Parked, sensor noise alone may look like a strut.
TEST(HorizonSurvey, IsNotClearOnNoise) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 0.024);
    HorizonSurvey survey(0.005, IntegrationRule::kBandLimited, 400);
    for (int k = 0; k < 5000; ++k) {
      const double body = noise(engine), wheel = noise(engine);
      survey.push({k * std::chrono::milliseconds(5), 9.81 + body, 9.81 + wheel});
    }
    EXPECT_FALSE(survey.isClear()) << seed;
  }
}

// So small that squares vanish: parameters that are no numbers are passed over.
TEST(HorizonSurvey, TakesNoParametersThatAreNoNumbers) {
  HorizonSurvey survey(0.02, IntegrationRule::kBandLimited, 100);
  for (const CornerSample& sample : healthyPaperDrive(20.0, 0.024))
    survey.push({sample.stamp, 1e-150 * sample.sprung_acceleration, 1e-150 * sample.unsprung_acceleration});
  EXPECT_NO_THROW(survey.horizonSamples());
}

}  // namespace
}  // namespace suspension_health_monitor
