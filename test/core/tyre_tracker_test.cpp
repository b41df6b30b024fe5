#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "quarter_car.h"
#include "simulated_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kRate = 1000.0;

SimulationOptions roadDrive(const std::string& vehicle, double noise, double duration = 20.0) {
  SimulationOptions options = scenario("iso_road", duration);
  options.vehicle = vehicle;
  options.rate = kRate;
  options.noise = noise;
  return options;
}

MonitorSettings neverForgetting() {
  MonitorSettings options;
  options.sample_period = 1.0 / kRate;
  options.forgetting_factor = 1.0;
  return options;
}

CornerSample cornerSample(const DriveSample& sample) {
  return {sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration};
}

void expectCar(const WheelEstimate& estimate, const QuarterCar& car, double tolerance) {
  EXPECT_TRUE(estimate.valid());
  EXPECT_NEAR(estimate.damping_to_wheel_mass * car.unsprung_mass / car.damping, 1.0, tolerance);
  EXPECT_NEAR(estimate.stiffness_to_wheel_mass * car.unsprung_mass / car.stiffness, 1.0, tolerance);
  EXPECT_NEAR(estimate.tyre_to_wheel_mass * car.unsprung_mass / *car.tyre_stiffness, 1.0, tolerance);
}

// w'' = a sin, u = c cos, mu'' - w'' = e sin of the same frequency: every column in closed form.
TEST(SuspensionRegression, WithSidesExchangedHasTheRowsOfTheWheelInClosedForm) {
  const double omega = 2.5, a = 0.7, c = -1.3, e = 0.4, h = 0.6, late = 0.24;
  const auto secondDifference = [&](const auto& f, double t) {
    return f(t - late) - 2.0 * f(t - late - h) + f(t - late - 2.0 * h);
  };
  const auto sine = [&](double t) { return std::sin(omega * t); };
  const auto cosine = [&](double t) { return std::cos(omega * t); };
  // As StrutIdentifier::ofWheel():
  SuspensionRegression regression({30, 0.02, IntegrationRule::kBandLimited}, 1, false, 0);
  int rows = 0;
  for (int k = 0; k < 200; ++k) {
    const double t = k * 0.02;
    const double w = a * sine(t), u = c * cosine(t);
    const double tyre = e * sine(t);
    const RegressionRow* row = regression.push({fromSeconds(t), w, w - u}, &tyre);
    ASSERT_EQ(row != nullptr, k >= 84);
    if (row == nullptr) continue;
    ++rows;
    EXPECT_NEAR(row->output, a * secondDifference(sine, t), 1e-13);
    EXPECT_NEAR(row->regressor[kDampingToMass], -c / omega * secondDifference(sine, t), 1e-5);
    EXPECT_NEAR(row->regressor[kStiffnessToMass], c / (omega * omega) * secondDifference(cosine, t), 1e-5);
    EXPECT_NEAR(row->regressor[kNumStrutParameters], -e / (omega * omega) * secondDifference(sine, t), 1e-5);
  }
  EXPECT_EQ(rows, 116);
}

// A rest, before the drive and in it, teaches nothing of how the estimates scatter.
TEST(TyreTracker, KnowsItsSpreadAfterARest) {
  MonitorSettings options = neverForgetting();
  options.forgetting_factor = 0.998;
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 0.024);
  const auto reportAfter = [&](double driven_before, double rest) {
    TyreTracker tracker(options);
    Stamp stamp{};
    const auto add = [&](double sprung, double unsprung, double road) {
      stamp += fromSeconds(1.0 / kRate);
      tracker.add({stamp, sprung, unsprung}, road);
    };
    const auto driveFor = [&](double seconds) {
      for (const DriveSample& sample : drive(roadDrive("golden_car", 0.024, seconds)))
        add(sample.sprung->acceleration, sample.unsprung->acceleration, sample.road->acceleration);
    };
    if (driven_before > 0.0) driveFor(driven_before);
    for (int k = 0; k < rest * kRate; ++k) {
      const double sprung = noise(random), unsprung = noise(random);
      add(sprung, unsprung, noise(random));
    }
    driveFor(15.0);
    return tracker.report();
  };
  const TyreReport without = reportAfter(0.0, 0.0);
  for (const double driven_before : {0.0, 10.0}) {
    const TyreReport after = reportAfter(driven_before, 10.0);
    for (const auto estimate : {&TyreReport::ls, &TyreReport::la}) {
      EXPECT_LT((after.*estimate).damping_to_wheel_mass_stddev, 2.5 * (without.*estimate).damping_to_wheel_mass_stddev);
      EXPECT_LT((after.*estimate).tyre_to_wheel_mass_stddev, 2.5 * (without.*estimate).tyre_to_wheel_mass_stddev);
    }
  }
}

// Without noise only the integration rule errs, by the fourth power of the sampling time: 90 samples per hop.
TEST(TyreTracker, FindsWheelAndTyreOfANoiseFreeDrive) {
  for (const char* vehicle : {"golden_car", "rover", "ugv"}) {
    SCOPED_TRACE(vehicle);
    const SimulationOptions options = roadDrive(vehicle, 0.0);
    TyreTracker tracker(neverForgetting());
    for (const DriveSample& sample : drive(options)) tracker.add(cornerSample(sample), sample.road->acceleration);
    expectCar(tracker.report().ls, carOf(options), 1e-4);
    expectCar(tracker.report().la, carOf(options), 1e-4);
  }
}

// The noise of w'' stands in psi and in the columns; at the default horizon this biases by the ratio of noise to motion
// under the integrals, (0.024 m/s^2 / several m/s^2)^2, far below 1 %.
TEST(TyreTracker, NoiseBiasesByLessThanAPercent) {
  const SimulationOptions options = roadDrive("golden_car", 0.024);
  TyreTracker tracker(neverForgetting());
  SuspensionMonitor strut(neverForgetting());
  for (const DriveSample& sample : drive(options)) {
    strut.addSample(cornerSample(sample));
    tracker.add(cornerSample(sample), sample.road->acceleration);
  }
  const QuarterCar car = carOf(options);
  expectCar(tracker.report().ls, car, 0.01);
  expectCar(tracker.report().la, car, 0.01);
  const std::optional<double> ratio = massRatio(strut.report().la, tracker.report().la);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(*ratio * car.sprung_mass / car.unsprung_mass, 1.0, 0.02);
}

TEST(TyreTracker, WithoutTheRoadsSensorThereIsNoEstimate) {
  TyreTracker tracker(neverForgetting());
  for (const DriveSample& sample : drive(roadDrive("golden_car", 0.0, 2.0)))
    EXPECT_FALSE(tracker.add(cornerSample(sample), std::nullopt).has_row);
  EXPECT_FALSE(tracker.report().la.valid());
  EXPECT_TRUE(std::isnan(tracker.report().ls.tyre_to_wheel_mass));
  EXPECT_FALSE(massRatio(StrutEstimate{}, tracker.report().la));
}

TEST(TyreTracker, OneMissingReadingEmptiesTheFilterAndKeepsTheEstimate) {
  TyreTracker tracker(neverForgetting());
  const int fill = LinearIntegralFilter::window(2, neverForgetting().tyreFilter(1.0 / kRate)) - 1;
  int since_loss = -1000000;
  double before = 0.0;
  for (const DriveSample& sample : drive(roadDrive("golden_car", 0.0, 4.0))) {
    const bool lost = sample.stamp == fromSeconds(3.0);
    if (lost) before = tracker.report().la.tyre_to_wheel_mass;
    const TyreReport& report =
        tracker.add(cornerSample(sample), lost ? std::nullopt : std::optional<double>(sample.road->acceleration));
    since_loss = lost ? 0 : since_loss + 1;
    if (since_loss < 0) continue;
    EXPECT_EQ(report.has_row, since_loss > fill) << since_loss;
    EXPECT_EQ(report.la.valid(), since_loss > fill) << since_loss;
    if (!report.has_row) {
      EXPECT_EQ(report.la.tyre_to_wheel_mass, before);
    }
  }
}

TEST(TyreTracker, HorizonIsAnEighthOfTheStrutsOfAtLeastFiveSamples) {
  MonitorSettings options = neverForgetting();
  EXPECT_EQ(options.tyreFilter(*options.sample_period).horizon_samples, 75);
  options.integration_horizon = 0.02;
  EXPECT_EQ(options.tyreFilter(*options.sample_period).horizon_samples, 5);
}

}  // namespace
}  // namespace suspension_health_monitor
