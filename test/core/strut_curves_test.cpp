#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hidden_effect.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {
namespace {

constexpr double kB1 = 6.0, kB0 = 63.3;          // of the reference car
constexpr double kRate = 0.19, kTravel = 0.008;  // its rms on the road of these tests [m/s], [m]
constexpr double kNinetyPercent = 1.645;         // standard deviations
const StrutModel kLinear{kB1, kB0, {}, {}};

Drive driveOf(const SimulationOptions& options, double gain = 1.0) {
  Drive result;
  for (const DriveSample& sample : drive(options))
    result.samples.push_back({sample.stamp, gain * sample.sprung->acceleration, gain * sample.unsprung->acceleration});
  return result;
}

SimulationOptions carWith(const std::string& name, std::vector<double> shapes, double share, double duration = 60.0,
                          double noise = 0.0) {
  SimulationOptions options = carDrive(duration, noise);
  options.hidden = {hiddenEffect(options, name, std::move(shapes), share)};
  return options;
}

double linear(double slope, double x) { return slope * x; }

/// No noise: what is left is the interpolation of w'' and of the law.
/// @param accuracy  [m/s^2].
void expectLaw(const ForceCurve& curve, const std::function<double(double)>& law, double usual, double accuracy) {
  ASSERT_TRUE(curve.covers(-2.0 * usual) && curve.covers(2.0 * usual));
  ASSERT_EQ(curve.at.size(), curve.force.size());
  ASSERT_EQ(curve.at.size(), curve.stddev.size());
  EXPECT_EQ(curve.forceAt(0.0), 0.0);
  EXPECT_TRUE(std::is_sorted(curve.at.begin(), curve.at.end()));
  for (std::size_t i = 0; i < curve.at.size(); ++i)
    EXPECT_NEAR(curve.force[i], law(curve.at[i]), accuracy + 3.0 * curve.stddev[i]) << curve.at[i];
}

// The free run is exact to kInterpolationAccuracy, 1e-3 or better, of an acceleration of some 1 m/s^2.
constexpr double kAccuracy = 1e-3;

TEST(StrutCurves, AreStraightLinesOfALinearStrutWithoutNoise) {
  const StrutCurves curves = strutCurves({driveOf(carDrive(60.0, 0.0))}, kLinear);
  expectLaw(
      curves.damper, [](double v) { return linear(kB1, v); }, kRate, kAccuracy);
  expectLaw(
      curves.spring, [](double d) { return linear(kB0, d); }, kTravel, kAccuracy);
  EXPECT_LT(curves.damper.stddevAt(kRate), kAccuracy);
}

TEST(StrutCurves, FollowADigressiveDamperFromALinearModelAndFromItsOwn) {
  const SimulationOptions options = carWith("digressive_damping", {0.15}, 0.5);
  const ActiveEffect& hidden = options.hidden.front();
  const auto law = [&](double v) {
    return kB1 * v + hidden.coefficient * v / std::sqrt(1.0 + std::pow(v / hidden.shapes[0], 2));
  };
  for (const StrutModel& model : {kLinear, StrutModel{kB1, kB0, {hidden}, {}}}) {
    const StrutCurves curves = strutCurves({driveOf(options)}, model);
    expectLaw(curves.damper, law, kRate / 1.5, 2.0 * kAccuracy);
    expectLaw(
        curves.spring, [](double d) { return linear(kB0, d); }, kTravel / 1.5, 2.0 * kAccuracy);
  }
}

TEST(StrutCurves, HaveTheHarderDirectionOnItsSide) {
  SimulationOptions options = carWith("asymmetric_damping", {}, 0.4);
  for (const double sign : {1.0, -1.0}) {
    options.hidden.front().coefficient = sign * std::abs(options.hidden.front().coefficient);
    const double c = options.hidden.front().coefficient;
    const ForceCurve damper = strutCurves({driveOf(options)}, kLinear).damper;
    expectLaw(
        damper, [&](double v) { return kB1 * v + c * std::abs(v); }, kRate / 1.5, 2.0 * kAccuracy);
    EXPECT_GT(sign * (damper.forceAt(kRate) + damper.forceAt(-kRate)), 0.0);
  }
}

// A line through a corner in the finest cell, a 128th of the largest travel of some 4 rms, is wrong by up to a quarter
// of the change of slope times its width.
TEST(StrutCurves, FindTheStopInTheSpring) {
  const SimulationOptions options = carWith("bump_stop", {0.008}, 0.3);
  const ActiveEffect& stop = options.hidden.front();
  const double accuracy = stop.coefficient * 4.0 * kTravel / 128.0 / 4.0;
  const auto law = [&](double d) { return kB0 * d + stop.coefficient * std::max(0.0, d - stop.shapes[0]); };
  const StrutCurves curves = strutCurves({driveOf(options)}, kLinear);
  expectLaw(
      curves.damper, [](double v) { return linear(kB1, v); }, kRate / 1.5, accuracy);
  expectLaw(curves.spring, law, kTravel / 1.5, accuracy);
}

// What travel and travel rate decide together is no curve of either.
TEST(StrutCurves, LeaveALawOfTwoVariablesToTheModel) {
  const SimulationOptions options = carWith("position_dependent_damping", {}, 0.3);
  const StrutCurves curves = strutCurves({driveOf(options)}, {kB1, kB0, options.hidden, {}});
  expectLaw(
      curves.damper, [](double v) { return linear(kB1, v); }, kRate / 1.5, 2.0 * kAccuracy);
  expectLaw(
      curves.spring, [](double d) { return linear(kB0, d); }, kTravel / 1.5, 2.0 * kAccuracy);
}

TEST(StrutCurves, ScaleWithTheUnitOfAcceleration) {
  const SimulationOptions options = carWith("coulomb_friction", {0.02}, 0.2, 40.0, 0.03);
  const StrutCurves once = strutCurves({driveOf(options)}, kLinear),
                    twice = strutCurves({driveOf(options, 2.0)}, kLinear);
  for (const auto curve : {&StrutCurves::damper, &StrutCurves::spring}) {
    ASSERT_EQ((once.*curve).at.size(), (twice.*curve).at.size());
    ASSERT_FALSE((once.*curve).at.empty());
    for (std::size_t i = 0; i < (once.*curve).at.size(); ++i) {
      EXPECT_NEAR((twice.*curve).at[i], 2.0 * (once.*curve).at[i], 1e-6 * (once.*curve).at.back());
      EXPECT_NEAR((twice.*curve).force[i], 2.0 * (once.*curve).force[i], 1e-2 * (once.*curve).stddev[i]);
      EXPECT_NEAR((twice.*curve).stddev[i], 2.0 * (once.*curve).stddev[i], 1e-4 * (once.*curve).stddev[i]);
    }
  }
}

// One value of each curve and drive, so that all are independent: of 48 that hold the law with a probability of 0.9
// fewer than 36 do so once in a thousand cases (binomial distribution), and their mean square is between 0.48 and 1.75
// of its expectation (chi-squared distribution, both ends together 0.002), which is 1 without what straight lines miss
// and at least a half with it.
TEST(StrutCurves, HoldTheLawAsOftenAsTheySay) {
  int held = 0;
  double square = 0.0;
  constexpr int kDrives = 24;
  for (int seed = 1; seed <= kDrives; ++seed) {
    SimulationOptions options = carWith("digressive_damping", {0.3}, 0.3, 30.0, 0.03);
    options.seed = seed;
    const ActiveEffect& hidden = options.hidden.front();
    const StrutCurves curves = strutCurves({driveOf(options)}, kLinear);
    const double v = (seed % 2 == 0 ? 1.0 : -1.0) * kRate / 2.0, d = kTravel / 2.0;
    ASSERT_TRUE(curves.damper.covers(v) && curves.spring.covers(d));
    const double law = kB1 * v + hidden.coefficient * v / std::sqrt(1.0 + std::pow(v / hidden.shapes[0], 2));
    for (const double error : {(curves.damper.forceAt(v) - law) / curves.damper.stddevAt(v),
                               (curves.spring.forceAt(d) - kB0 * d) / curves.spring.stddevAt(d)}) {
      held += std::abs(error) <= kNinetyPercent;
      square += error * error / (2.0 * kDrives);
    }
  }
  EXPECT_GE(held, 36);
  EXPECT_GT(square, 0.5 * 0.48);
  EXPECT_LT(square, 1.75);
}

TEST(StrutCurves, EndWhereTheDrivesSayNothing) {
  const SimulationOptions options = carDrive(60.0, 0.1);
  const StrutCurves curves = strutCurves({driveOf(options)}, kLinear);
  ASSERT_TRUE(curves.damper.covers(kRate));
  double most = 0.0;
  for (const DriveSample& sample : drive(options)) most = std::max(most, std::abs(sample.truth.travel_rate));
  EXPECT_FALSE(curves.damper.covers(-most) && curves.damper.covers(most));
  for (std::size_t i = 0; i < curves.damper.at.size(); ++i)
    EXPECT_LT(curves.damper.stddev[i], 0.1 * std::max(1.1 * kB1 * kRate, std::abs(curves.damper.force[i])));
}

TEST(StrutCurves, AbsolutelyHaveTheErrorOfTheVehiclesModelInEveryForce) {
  const ForceCurve absolute = ForceCurve{{-1.0, 0.0, 2.0}, {-3.0, 0.0, 8.0}, {0.4, 0.0, 0.6}, 0.1}.absolute();
  EXPECT_DOUBLE_EQ(absolute.stddev[0], 0.5);
  EXPECT_EQ(absolute.stddev[1], 0.0);
  EXPECT_DOUBLE_EQ(absolute.stddev[2], 1.0);
  EXPECT_EQ(absolute.absolute().stddev, absolute.stddev) << "only once";
}

TEST(StrutCurves, AreEmptyOfTooShortADriveAndOfOneThatDoesNotMove) {
  EXPECT_TRUE(strutCurves({driveOf(carDrive(3.0, 0.0))}, kLinear).damper.at.empty());
  Drive parked;
  for (int k = 0; k < 6000; ++k) parked.samples.push_back({fromSeconds(0.01 * k), 9.81, 9.81});
  const StrutCurves curves = strutCurves({parked}, kLinear);
  EXPECT_TRUE(curves.damper.at.empty() && curves.spring.at.empty());
  EXPECT_FALSE(curves.damper.covers(0.0));
}

TEST(StrutCurves, RefuseWhatCannotBe) {
  EXPECT_THROW(strutCurves({}, kLinear), std::invalid_argument);
  EXPECT_THROW(strutCurves({driveOf(carDrive(3.0, 0.0))}, kLinear, -0.01), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
