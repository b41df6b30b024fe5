#include "suspension_health_monitor/internal/health/inspection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace suspension_health_monitor {
namespace {

constexpr double kGravity = 9.80665, kStroke = 0.003;

InspectedStrut strutOf(const std::string& name, double damping, double stddev, double stiffness = 60.0) {
  InspectedStrut strut;
  strut.name = name;
  strut.estimate.damping_to_mass = damping;
  strut.estimate.stiffness_to_mass = stiffness;
  strut.estimate.damping_to_mass_stddev = stddev * damping;
  strut.estimate.stiffness_to_mass_stddev = stddev * stiffness;
  return strut;
}

std::vector<InspectedStrut> axle(double left, double right, double stddev = 0.01) {
  return {strutOf("front_left", left, stddev), strutOf("front_right", right, stddev)};
}

const InspectedNumber& find(const Inspection& found, InspectedQuantity quantity, std::size_t place = 0) {
  for (const InspectedNumber& number : found.numbers)
    if (number.quantity == quantity && place-- == 0) return number;
  throw std::logic_error("not inspected");
}

TEST(PlateTest, AWheelThatStandsHasItsStaticLoad) {
  EXPECT_DOUBLE_EQ(adhesionAt(0.0, {3.0, 60.0}, 0.1, 600.0), 1.0);
  EXPECT_NEAR(adhesionAt(0.01, {3.0, 60.0}, 0.1, 600.0), 1.0, 1e-5);
}

TEST(PlateTest, ARigidTyreCarriesTheInertiaOfWheelAndBody) {
  // w = u: the load swings by |m w'' + M z''|, of a body without strut by m w'' alone.
  const double frequency = 4.0, omega = 2.0 * M_PI * frequency, mass_ratio = 0.1;
  const double wheel_alone = 1.0 - mass_ratio * omega * omega * kStroke / ((1.0 + mass_ratio) * kGravity);
  EXPECT_NEAR(adhesionAt(frequency, {1e-9, 1e-9}, mass_ratio, 1e12), wheel_alone, 1e-6);
}

TEST(PlateTest, ARigidStrutMakesOneMassOnTheTyre) {
  // (M + m) w'' = K0 (u - w): the load swings by K0 omega^2 / (omega_0^2 - omega^2) u over (M + m).
  const double frequency = 2.0, omega = 2.0 * M_PI * frequency, mass_ratio = 0.1, tyre = 600.0;
  const double resonance = tyre / (1.0 + mass_ratio);
  const double swing = tyre * omega * omega / std::abs(resonance - omega * omega) * kStroke;
  EXPECT_NEAR(adhesionAt(frequency, {0.0, 1e12}, mass_ratio, tyre), 1.0 - swing / ((1.0 + mass_ratio) * kGravity),
              1e-6);
}

TEST(PlateTest, AWheelWithoutDampingLeavesThePlateAtItsResonance) {
  EXPECT_DOUBLE_EQ(leastAdhesion({1e-6, 60.0}, 0.1, 600.0), 0.0);
}

// The equations of motion of body and wheel, integrated until they have settled.
TEST(PlateTest, AgreesWithTheEquationsOfMotion) {
  const LinearStrut car{3.0, 60.0};
  const double mass_ratio = 0.12, tyre_to_mass = 500.0;
  const double frequency = 11.0, omega = 2.0 * M_PI * frequency, step = 1e-5;
  double z = 0.0, z_rate = 0.0, w = 0.0, w_rate = 0.0, least = 0.0;
  for (int i = 0; i < 600'000; ++i) {
    const double t = i * step, strut = car.damping_to_mass * (w_rate - z_rate) + car.stiffness_to_mass * (w - z);
    const double tyre = tyre_to_mass * (kStroke * std::sin(omega * t) - w);
    z_rate += step * strut;
    w_rate += step * (tyre - strut) / mass_ratio;
    z += step * z_rate;
    w += step * w_rate;
    if (t > 4.0) least = std::min(least, tyre);
  }
  EXPECT_NEAR(adhesionAt(frequency, car, mass_ratio, tyre_to_mass), 1.0 + least / ((1.0 + mass_ratio) * kGravity),
              1e-3);
}

TEST(Inspection, TheDampingRatioIsThatOfTheStrutWithItsInterval) {
  const Inspection found = inspect({strutOf("strut", 3.0, 0.02)});
  const InspectedNumber& ratio = find(found, InspectedQuantity::kDampingRatio);
  EXPECT_NEAR(ratio.value, 3.0 / (2.0 * std::sqrt(60.0)), 1e-12);
  // Relative errors of b1, and half of that of b0, independent.
  EXPECT_NEAR(ratio.interval.high / ratio.value - 1.0, 1.96 * 0.02 * std::sqrt(1.25), 1e-5);
  EXPECT_EQ(ratio.verdict, InspectionVerdict::kPasses);
  EXPECT_EQ(found.verdict, InspectionVerdict::kPasses);
  const ValueRange& frequency = found.frequencies[0];
  EXPECT_NEAR(std::pow(frequency.high, 2) - std::pow(frequency.low, 2), 2.0 * 1.96 * 0.02 * 60.0 / (4.0 * M_PI * M_PI),
              1e-4);
}

TEST(Inspection, LeftAndRightMayBeExchanged) {
  const Inspection one = inspect(axle(2.0, 4.0)), other = inspect(axle(4.0, 2.0));
  const auto &a = find(one, InspectedQuantity::kDampingImbalance),
             &b = find(other, InspectedQuantity::kDampingImbalance);
  EXPECT_NEAR(a.value, 0.5, 1e-12);
  EXPECT_NEAR(a.value, b.value, 1e-12);
  EXPECT_NEAR(a.interval.low, b.interval.low, 1e-12);
  EXPECT_EQ(a.weaker, 0U);
  EXPECT_EQ(b.weaker, 1U);
  EXPECT_EQ(a.verdict, InspectionVerdict::kFails);
  EXPECT_EQ(find(one, InspectedQuantity::kStiffnessImbalance).verdict, InspectionVerdict::kPasses);
  EXPECT_EQ(one.verdict, InspectionVerdict::kFails);
}

TEST(Inspection, EqualStrutsHaveNoImbalance) {
  const Inspection found = inspect(axle(3.0, 3.0));
  const InspectedNumber& number = find(found, InspectedQuantity::kDampingImbalance);
  EXPECT_DOUBLE_EQ(number.value, 0.0);
  EXPECT_DOUBLE_EQ(number.interval.low, 0.0);
  EXPECT_NEAR(number.interval.high, 1.96 * 0.01 * std::sqrt(2.0), 1e-5);
}

TEST(Inspection, PlacesTellLeftFromRight) {
  std::vector<InspectedStrut> struts = axle(2.0, 4.0);
  struts[0].name = "a";
  struts[1].name = "b";
  EXPECT_THROW(find(inspect(struts), InspectedQuantity::kDampingImbalance), std::logic_error);
  struts[0].place = {1.0, -0.7};
  struts[1].place = {1.0, 0.7};
  const InspectedNumber number = find(inspect(struts), InspectedQuantity::kDampingImbalance);
  EXPECT_EQ(number.struts, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(number.weaker, 0U);
}

// At relative stddev s of a strut their ratio has s sqrt(2). What is between the limit's interval and the wider one
// cannot be told, and so much longer a drive would tell.
TEST(Inspection, WhatIsNearTheLimitIsDecidedByALongerDrive) {
  const auto number = [](double right, double stddev) {
    return find(inspect(axle(3.0, right, stddev)), InspectedQuantity::kDampingImbalance);
  };
  EXPECT_EQ(number(3.0 * 0.75, 0.01).verdict, InspectionVerdict::kPasses);
  EXPECT_EQ(number(3.0 * 0.64, 0.01).verdict, InspectionVerdict::kFails);
  const InspectedNumber near = number(3.0 * 0.75, 0.04);
  EXPECT_EQ(near.verdict, InspectionVerdict::kCannotTell);
  // 0.75 - 0.7 = 1.96 0.75 0.04 sqrt(2 / n): n = 2.8, so 4 of 2, 4, 8, 16.
  ASSERT_TRUE(near.longer);
  EXPECT_DOUBLE_EQ(*near.longer, 4.0);
  EXPECT_FALSE(number(3.0 * 0.7001, 0.04).longer);
}

TEST(Inspection, AFailureIsCertainForAllNumbersTogether) {
  // Four numbers: each may fail by chance with 0.25 %, which is 2.81 standard deviations.
  const auto verdict = [](double sigmas) {
    const double stddev = 0.01 * std::sqrt(2.0);
    return find(inspect(axle(3.0, 3.0 * 0.7 / (1.0 + sigmas * stddev))), InspectedQuantity::kDampingImbalance).verdict;
  };
  EXPECT_EQ(verdict(2.75), InspectionVerdict::kCannotTell);
  EXPECT_EQ(verdict(2.85), InspectionVerdict::kFails);
}

TEST(Inspection, TheModelsErrorIsInTheDampingRatioAndNearlyCancelsInTheImbalance) {
  std::vector<InspectedStrut> struts = axle(3.0, 2.85, 0.001);
  for (InspectedStrut& strut : struts) strut.estimate.damping_model_stddev = 0.1 * strut.estimate.damping_to_mass;
  const Inspection found = inspect(struts);
  const InspectedNumber& ratio = find(found, InspectedQuantity::kDampingRatio);
  EXPECT_NEAR(ratio.interval.high / ratio.value - 1.0, 1.96 * 0.1, 0.002);
  EXPECT_LT(find(found, InspectedQuantity::kDampingImbalance).interval.high, 0.05 + 1.96 * 0.1 / 2.0);
}

TEST(Inspection, ADeadDamperFails) {
  std::vector<InspectedStrut> struts = axle(3.0, 1.0);
  struts[1].estimate.damping_to_mass = -0.02;
  struts[1].estimate.damping_to_mass_stddev = 0.2;
  const Inspection found = inspect(struts);
  EXPECT_EQ(find(found, InspectedQuantity::kDampingRatio, 1).verdict, InspectionVerdict::kFails);
  EXPECT_EQ(find(found, InspectedQuantity::kDampingImbalance).verdict, InspectionVerdict::kFails);
  EXPECT_EQ(find(found, InspectedQuantity::kDampingImbalance).weaker, 1U);
}

TEST(Inspection, AnEstimateInDoubtTellsNothing) {
  std::vector<InspectedStrut> struts = axle(3.0, 1.0);
  struts[1].doubt = "too little motion";
  const Inspection found = inspect(struts);
  EXPECT_EQ(found.verdict, InspectionVerdict::kCannotTell);
  const InspectedNumber& number = find(found, InspectedQuantity::kDampingImbalance);
  EXPECT_TRUE(std::isnan(number.value));
  EXPECT_EQ(describe(number, struts, 60.0), "cannot tell: too little motion");
  EXPECT_EQ(find(found, InspectedQuantity::kDampingRatio).verdict, InspectionVerdict::kPasses);
}

TEST(Inspection, AdhesionIsThatOfAllWheelsInTheRange) {
  InspectedStrut strut = strutOf("strut", 3.0, 1e-6);
  strut.wheel = WheelRanges{{0.1, 0.15}, {400.0, 600.0}};
  const InspectedNumber number = find(inspect({strut}), InspectedQuantity::kAdhesion);
  for (const double mass : {0.1, 0.12, 0.15})
    for (const double tyre : {400.0, 500.0, 600.0}) {
      const double adhesion = leastAdhesion({3.0, 60.0}, mass, tyre);
      EXPECT_LE(number.interval.low, adhesion + 1e-3);
      EXPECT_GE(number.interval.high, adhesion - 1e-3);
    }
  EXPECT_LT(number.interval.low, number.value);
}

}  // namespace
}  // namespace suspension_health_monitor
