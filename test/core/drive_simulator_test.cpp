#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "quarter_car.h"
#include "reference/quarter_car_forms.h"
#include "simulated_drive.h"
#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {
namespace {

TEST(DriveSimulator, SamplesBothEndsOfTheDrive) {
  const std::vector<DriveSample> samples = drive(scenario("paper_clean", 2.0));
  ASSERT_EQ(samples.size(), 101u);
  EXPECT_EQ(samples.front().stamp, Stamp(0));
  EXPECT_EQ(samples[1].stamp, std::chrono::milliseconds(20));
  EXPECT_EQ(samples.back().stamp, std::chrono::seconds(2));
  EXPECT_EQ(samples.back().sprung->stamp, samples.back().stamp);
  EXPECT_EQ(samples.front().truth.travel, 0.0);
  EXPECT_EQ(samples.front().truth.travel_rate, 0.0);
}

TEST(DriveSimulator, AgreesWithAnIndependentSimulationOfThePaper) {
  std::ifstream file(TEST_DATA_DIR "/input_paper.csv");
  ASSERT_TRUE(file);
  std::string header;
  std::getline(file, header);
  DriveSimulator simulator(scenario("paper_outliers"));
  const double half_width = 0.024 * std::sqrt(3.0);
  std::vector<double> sprung, unsprung;
  double t, y, w;
  for (char comma; file >> t >> comma >> y >> comma >> w;) {
    const std::optional<DriveSample> sample = simulator.next();
    ASSERT_TRUE(sample);
    ASSERT_NEAR(toSeconds(sample->stamp), t, 1e-9);
    if (t >= 25.0 && t <= 26.0) continue;
    sprung.push_back(y - sample->truth.sprung_acceleration);
    unsprung.push_back(w - sample->truth.unsprung_acceleration);
    // The file's noise is uniform; the rest is for the integration error of both sides.
    EXPECT_LE(std::abs(sprung.back()), half_width + 1e-8) << "sprung, at " << t << " s";
    EXPECT_LE(std::abs(unsprung.back()), half_width + 1e-8) << "unsprung, at " << t << " s";
  }
  ASSERT_EQ(sprung.size(), 2001u - 51u);
  const double mean_tolerance = 4.0 * 0.024 / std::sqrt(1950.0);
  EXPECT_NEAR(meanOf(sprung), 0.0, mean_tolerance);
  EXPECT_NEAR(meanOf(unsprung), 0.0, mean_tolerance);
  // Of a uniform variable the sample deviation scatters by sqrt(0.8 / N) / 2 = 1 %.
  EXPECT_NEAR(standardDeviationOf(sprung), 0.024, 0.04 * 0.024);
}

// Steady response to the road (31), from the state-space matrices: height to z'' and w''.
Eigen::Vector2d steadyAccelerations(const RoadDrivenForm& form, double t) {
  const double amplitudes[] = {0.01, 0.02, 0.03, 0.04}, periods[] = {1.3, 1.9, 2.5, 2.8};
  Eigen::Vector2d sum(0.0, 0.0);
  for (int i = 0; i < 4; ++i) {
    const std::complex<double> s(0.0, 2.0 * M_PI / periods[i]);
    const Eigen::Matrix4cd resolvent = s * Eigen::Matrix4cd::Identity() - form.a.cast<std::complex<double>>();
    const Eigen::Vector4cd states = resolvent.partialPivLu().solve(form.b.cast<std::complex<double>>());
    const std::complex<double> road = -amplitudes[i] * std::exp(s * t);
    sum += (s * s * road * states.head<2>()).real();
  }
  return sum;
}

TEST(DriveSimulator, SettlesToTheTransferFunctionOfTheFullForm) {
  SimulationOptions options = scenario("paper_clean", 40.0);
  options.vehicle = "ugv";
  options.damping_end_fraction = 1.0;
  const RoadDrivenForm form = roadDrivenForm(carOf(options));
  for (const DriveSample& sample : drive(options)) {
    const double t = toSeconds(sample.stamp);
    if (t < 20.0) continue;  // b1 / 2 = 2 1/s: the start has decayed by exp(-40)
    const Eigen::Vector2d expected = steadyAccelerations(form, t);
    ASSERT_NEAR(sample.truth.sprung_acceleration, expected[0], 1e-7) << "at " << t << " s";
    ASSERT_NEAR(sample.truth.unsprung_acceleration, expected[1], 1e-7) << "at " << t << " s";
  }
}

TEST(DriveSimulator, RelativeAccelerationIsTheSecondDerivativeOfTravel) {
  for (const char* vehicle : {"paper", "golden_car", "rover", "ugv"}) {
    SimulationOptions options = scenario("iso_road", 5.0);
    options.vehicle = vehicle;
    options.rate = 2000.0;
    const std::vector<DriveSample> samples = drive(options);
    double error = 0.0, square = 0.0;
    for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
      const DriveTruth& here = samples[i].truth;
      const double difference = samples[i + 1].truth.travel - 2.0 * here.travel + samples[i - 1].truth.travel;
      const double relative = here.unsprung_acceleration - here.sprung_acceleration;
      error += std::pow(difference * 2000.0 * 2000.0 - relative, 2);
      square += relative * relative;
      const double slope = (samples[i + 1].truth.travel - samples[i - 1].truth.travel) * 1000.0;
      ASSERT_NEAR(slope, here.travel_rate, 1e-3);
      ASSERT_DOUBLE_EQ(here.sprung_acceleration,
                       here.damping_to_mass * here.travel_rate + here.stiffness_to_mass * here.travel);
    }
    // (omega h)^2 / 12 = 0.15 % at the fastest, 42.5 Hz.
    EXPECT_LT(std::sqrt(error / square), 2e-3) << vehicle;
  }
}

TEST(DriveSimulator, DampingFallsAlongThePapersRamp) {
  for (const DriveSample& sample : drive(scenario("paper_clean"))) {
    const double t = toSeconds(sample.stamp);
    const double expected = t < 40.0 ? 3.0 : t > 100.0 ? 2.0 : 3.0 - (t - 40.0) / 60.0;
    ASSERT_NEAR(sample.truth.damping_to_mass, expected, 1e-12) << "at " << t << " s";
    ASSERT_NEAR(sample.truth.stiffness_to_mass, 13.8, 1e-12);
  }
}

TEST(DriveSimulator, DampingOfWhichAllIsLeftIsAHealthyDrive) {
  for (const char* name : {"paper_saturation", "iso_road"}) {
    SimulationOptions options = scenario(name, 110.0);
    options.rate = 1.0;
    options.damping_end_fraction = 1.0;
    EXPECT_DOUBLE_EQ(drive(options).back().truth.damping_to_mass, carOf(options).dampingToMass());
  }
}

TEST(DriveSimulator, IsoRoadLosesDampingOnlyWhenAsked) {
  SimulationOptions options = scenario("iso_road", 30.0);
  options.rate = 10.0;
  options.ramp_start = 10.0;
  options.ramp_end = 20.0;
  EXPECT_DOUBLE_EQ(drive(options).back().truth.damping_to_mass, 6.0);
  options.damping_end_fraction = 0.5;
  const std::vector<DriveSample> samples = drive(options);
  EXPECT_DOUBLE_EQ(samples.front().truth.damping_to_mass, 6.0);
  EXPECT_DOUBLE_EQ(samples[150].truth.damping_to_mass, 4.5);
  EXPECT_DOUBLE_EQ(samples.back().truth.damping_to_mass, 3.0);
}

TEST(DriveSimulator, BothReadingsAreZeroInTheLossWindowsOnly) {
  int lost = 0;
  for (const DriveSample& sample : drive(scenario("paper_outliers"))) {
    const double t = toSeconds(sample.stamp);
    const bool expected = (t >= 25.0 && t <= 26.0) || (t >= 65.0 && t <= 66.0);
    ASSERT_EQ(sample.sprung->acceleration == 0.0, expected) << "at " << t << " s";
    ASSERT_EQ(sample.unsprung->acceleration == 0.0, expected) << "at " << t << " s";
    if (!expected) continue;
    EXPECT_GT(std::abs(sample.truth.unsprung_acceleration), 1e-6) << "only the readings are lost";
    ++lost;
  }
  EXPECT_EQ(lost, 2 * 51);
}

TEST(DriveSimulator, BumpsAndNothingElseReachTheEndStops) {
  const std::vector<DriveSample> clean = drive(scenario("paper_clean"));
  const std::vector<DriveSample> saturated = drive(scenario("paper_saturation"));
  int beyond[2] = {0, 0};
  for (std::size_t i = 0; i < saturated.size(); ++i) {
    const DriveTruth& truth = saturated[i].truth;
    const double t = toSeconds(saturated[i].stamp);
    if (t < 83.0) {
      ASSERT_NEAR(truth.travel, clean[i].truth.travel, 1e-8) << "at " << t << " s";
    }
    const double linear = truth.damping_to_mass * truth.travel_rate + truth.stiffness_to_mass * truth.travel;
    const double stops = truth.sprung_acceleration - linear;
    if (std::abs(truth.travel) <= 0.09) {
      ASSERT_NEAR(stops, 0.0, 1e-12);
      continue;
    }
    ASSERT_NEAR(stops, std::copysign(1000.0 * (std::abs(truth.travel) - 0.09), truth.travel), 1e-9);
    ASSERT_TRUE(std::abs(t - 85.0) < 2.0 || std::abs(t - 110.0) < 2.0) << "end stop at " << t << " s";
    ++beyond[t < 100.0 ? 0 : 1];
  }
  EXPECT_GT(beyond[0], 0);
  EXPECT_GT(beyond[1], 0);
}

TEST(DriveSimulator, EndStopsLimitTheTravelByTheirEnergy) {
  SimulationOptions options = scenario("paper_saturation");
  options.rate = 500.0;
  double farthest = 0.0, fastest_arrival = 0.0, previous = 0.0;
  for (const DriveSample& sample : drive(options)) {
    const double travel = std::abs(sample.truth.travel);
    if (travel > 0.09 && previous <= 0.09) {
      fastest_arrival = std::max(fastest_arrival, std::abs(sample.truth.travel_rate));
    }
    farthest = std::max(farthest, travel);
    previous = travel;
  }
  // Beyond the gap x'' <= A - 1000 x with A = 7.6 m/s^2, the most that road and bump push, so a stop that is met at v
  // gives way by x with 1000 x^2 / 2 <= v^2 / 2 + A x.
  const double give = (7.6 + std::sqrt(7.6 * 7.6 + 1000.0 * fastest_arrival * fastest_arrival)) / 1000.0;
  EXPECT_GT(farthest, 0.09);
  EXPECT_LT(farthest, 0.09 + give);
}

TEST(DriveSimulator, HiddenEffectAddsItsForceAndNothingElse) {
  for (const char* vehicle : {"paper", "golden_car"}) {
    SimulationOptions options = scenario("iso_road", 5.0);
    options.vehicle = vehicle;
    options.hidden = {{findEffect(forceEffects(), "asymmetric_damping"), -0.7, {}},
                      {findEffect(forceEffects(), "bump_stop"), 40.0, {0.001}}};
    double largest = 0.0;
    for (const DriveSample& sample : drive(options)) {
      const DriveTruth& truth = sample.truth;
      const double linear = truth.damping_to_mass * truth.travel_rate + truth.stiffness_to_mass * truth.travel;
      const double hidden = -0.7 * std::abs(truth.travel_rate) + 40.0 * std::max(0.0, truth.travel - 0.001);
      ASSERT_NEAR(truth.sprung_acceleration, linear + hidden, 1e-12) << vehicle;
      largest = std::max(largest, std::abs(hidden));
    }
    EXPECT_GT(largest, 0.01) << vehicle;
  }
}

TEST(DriveSimulator, HiddenForceActsBackOnTheWheel) {
  SimulationOptions options = scenario("iso_road", 1.0);
  options.vehicle = "golden_car";
  ForceEffect lift = findEffect(forceEffects(), "asymmetric_spring");
  lift.force = [](const StrutMotion&, const double*) { return 1.0; };  // [m/s^2]
  const DriveTruth plain = drive(options).front().truth;
  options.hidden = {{lift, 2.0, {}}};
  const DriveTruth lifted = drive(options).front().truth;
  EXPECT_NEAR(lifted.sprung_acceleration - plain.sprung_acceleration, 2.0, 1e-12);
  EXPECT_NEAR(lifted.unsprung_acceleration - plain.unsprung_acceleration, -2.0 * 250.0 / 37.5, 1e-9);
}

TEST(DriveSimulator, HiddenMemoriesFollowTheirLaws) {
  SimulationOptions options = scenario("iso_road", 4.0);
  options.vehicle = "golden_car";
  options.rate = 2000.0;
  options.hidden = {{findEffect(forceEffects(), "damping_drift"), 0.1, {}},
                    {findEffect(forceEffects(), "viscoelastic_mount"), 30.0, {0.05}}};
  double memory = 0.0, travel = 0.0, largest = 0.0;
  for (const DriveSample& sample : drive(options)) {
    const DriveTruth& truth = sample.truth;
    const double t = toSeconds(sample.stamp);
    // s' = (d - s) / tau by the trapezoid rule.
    const double a = 0.0005 / (2.0 * 0.05);
    if (t > 0.0) memory = (memory * (1.0 - a) + a * (travel + truth.travel)) / (1.0 + a);
    travel = truth.travel;
    const double linear = (truth.damping_to_mass + 0.1 * t) * truth.travel_rate + truth.stiffness_to_mass * travel;
    ASSERT_NEAR(truth.sprung_acceleration, linear + 30.0 * (travel - memory), 1e-3) << t;
    largest = std::max(largest, std::abs(30.0 * (travel - memory)));
  }
  EXPECT_GT(largest, 0.1);
}

TEST(DriveSimulator, MoreHiddenEffectsThanItHoldsAreRefused) {
  SimulationOptions options = scenario("iso_road", 1.0);
  const ActiveEffect effect{findEffect(forceEffects(), "asymmetric_damping"), 0.1, {}};
  options.hidden.assign(4, effect);
  EXPECT_NO_THROW(drive(options));
  options.hidden.assign(5, effect);
  EXPECT_THROW(drive(options), std::invalid_argument);
}

TEST(DriveSimulator, SameOptionsGiveIdenticalSamples) {
  SimulationOptions options = scenario("iso_road", 5.0);
  options.dropout = 0.1;
  options.stamp_jitter = 0.005;
  options.gaussian_noise = true;
  const std::vector<DriveSample> first = drive(options), second = drive(options);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].sprung.has_value(), second[i].sprung.has_value());
    if (!first[i].sprung) continue;
    ASSERT_EQ(first[i].sprung->stamp, second[i].sprung->stamp);
    ASSERT_EQ(first[i].sprung->acceleration, second[i].sprung->acceleration);
  }
}

}  // namespace
}  // namespace suspension_health_monitor
