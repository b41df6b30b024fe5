// M/Iyy, M/Ixx and the centre of gravity against the closed form of the coupling ratios.
#include "suspension_health_monitor/internal/vehicle/body_inertia.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace suspension_health_monitor {
namespace {

constexpr double kPitch = 0.55, kRoll = 2.4;         // M/Iyy, M/Ixx [1/m^2]
constexpr double kCentreX = 0.13, kCentreY = -0.04;  // of the centre of gravity, from where places count [m]
const StrutPlaces kSedan{{1.2, 0.75}, {1.2, -0.75}, {-1.5, 0.74}, {-1.5, -0.74}};
const StrutPlaces kTricycle{{0.8, 0.0}, {-0.4, 0.5}, {-0.4, -0.5}};
const StrutPlaces kTruck{{2.0, 0.9}, {2.0, -0.9}, {-1.0, 0.95}, {-1.0, -0.95}, {-2.2, 0.95}, {-2.2, -0.95}};

/// M a_ij of the body above.
double mobility(const std::array<double, 2>& i, const std::array<double, 2>& j) {
  return 1.0 + kPitch * (i[0] - kCentreX) * (j[0] - kCentreX) + kRoll * (i[1] - kCentreY) * (j[1] - kCentreY);
}

Eigen::MatrixXd ratiosOf(const StrutPlaces& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd ratios(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto &a = places[static_cast<std::size_t>(i)], &b = places[static_cast<std::size_t>(j)];
      ratios(i, j) = mobility(a, b) / mobility(b, b);
    }
  return ratios;
}

Eigen::MatrixXd constant(const StrutPlaces& places, double value) {
  const auto n = static_cast<Eigen::Index>(places.size());
  return Eigen::MatrixXd::Constant(n, n, value);
}

BodyInertiaResult resultOf(const StrutPlaces& true_places, const StrutPlaces& said) {
  return bodyInertia(ratiosOf(true_places), constant(true_places, 0.004), said);
}

class ExactRatios : public ::testing::TestWithParam<StrutPlaces> {};

TEST_P(ExactRatios, TellTheBody) {
  const BodyInertiaResult found = resultOf(GetParam(), GetParam());
  ASSERT_TRUE(found.body);
  EXPECT_EQ(found.doubt, InertiaDoubt::kNone);
  EXPECT_NEAR(found.body->mass_to_pitch_inertia.value, kPitch, 1e-9);
  EXPECT_NEAR(found.body->mass_to_roll_inertia.value, kRoll, 1e-9);
  EXPECT_NEAR(found.body->x.value, kCentreX, 1e-9);
  EXPECT_NEAR(found.body->y.value, kCentreY, 1e-9);
}

TEST_P(ExactRatios, PlacesMayCountFromAnyPoint) {
  StrutPlaces moved = GetParam();
  for (auto& [x, y] : moved) {
    x += 0.7;
    y -= 1.9;
  }
  const BodyInertiaResult found = resultOf(GetParam(), moved), before = resultOf(GetParam(), GetParam());
  ASSERT_TRUE(found.body && before.body);
  EXPECT_NEAR(found.body->mass_to_pitch_inertia.value, kPitch, 1e-9);
  EXPECT_NEAR(found.body->mass_to_roll_inertia.value, kRoll, 1e-9);
  EXPECT_NEAR(found.body->x.value, kCentreX + 0.7, 1e-9);
  EXPECT_NEAR(found.body->y.value, kCentreY - 1.9, 1e-9);
  EXPECT_NEAR(found.body->mass_to_roll_inertia.stddev, before.body->mass_to_roll_inertia.stddev, 1e-9);
}

TEST_P(ExactRatios, StandardDeviationsAreThoseOfTheErrors) {
  std::mt19937 engine(11);
  std::normal_distribution<double> error;
  const Eigen::MatrixXd ratios = ratiosOf(GetParam());
  const Eigen::Index n = ratios.rows();
  Eigen::MatrixXd stddevs(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) stddevs(i, j) = 0.001 * static_cast<double>(1 + (i + 2 * j) % 3);
  constexpr int kDraws = 2000;
  int inside_pitch = 0, inside_roll = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::MatrixXd measured = ratios;
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        if (i != j) measured(i, j) += stddevs(i, j) * error(engine);
    const BodyInertiaResult found = bodyInertia(measured, stddevs, GetParam());
    ASSERT_TRUE(found.body);
    const auto isInside = [](const Measured& number, double truth) {
      return std::abs(number.value - truth) < 1.96 * number.stddev;
    };
    inside_pitch += isInside(found.body->mass_to_pitch_inertia, kPitch) ? 1 : 0;
    inside_roll += isInside(found.body->mass_to_roll_inertia, kRoll) ? 1 : 0;
  }
  // 95 %, and more where a misfit by chance makes them larger; 2000 draws tell the share within 1.5 % (3 sigma).
  EXPECT_GT(inside_pitch, 0.935 * kDraws);
  EXPECT_GT(inside_roll, 0.935 * kDraws);
  EXPECT_LT(inside_pitch, 0.99 * kDraws);
  EXPECT_LT(inside_roll, 0.99 * kDraws);
}

INSTANTIATE_TEST_SUITE_P(Vehicles, ExactRatios, ::testing::Values(kSedan, kTricycle, kTruck));

TEST(BodyInertia, PlacesOnOneLineDoNotTell) {
  for (const StrutPlaces& places :
       {StrutPlaces{{1.0, 0.0}, {-1.0, 0.0}}, StrutPlaces{{1.0, 0.5}, {-1.0, -0.5}},
        StrutPlaces{{1.0, 0.2}, {0.0, 0.2}, {-1.0, 0.2}}, StrutPlaces{{0.3, 1.0}, {0.3, 0.0}, {0.3, -1.0}}})
    EXPECT_EQ(resultOf(places, places).doubt, InertiaDoubt::kOnOneLine);
}

TEST(BodyInertia, WithoutPlacesNothingIsTold) { EXPECT_EQ(resultOf(kSedan, {}).doubt, InertiaDoubt::kNoPositions); }

TEST(BodyInertia, RatiosThatDoNotFitThePlacesDoNotTell) {
  StrutPlaces swapped = kSedan;
  std::swap(swapped[0], swapped[2]);  // of one side: no other rectangle has its corners in this order
  const BodyInertiaResult found = resultOf(kSedan, swapped);
  EXPECT_FALSE(found.body);
  EXPECT_EQ(found.doubt, InertiaDoubt::kUncertain);
}

TEST(BodyInertia, PlacesThatAreALittleWrongWidenTheDeviations) {
  StrutPlaces wrong = kSedan;
  wrong[0][0] += 0.1;
  const BodyInertiaResult found = bodyInertia(ratiosOf(kSedan), constant(kSedan, 0.001), wrong);
  const BodyInertiaResult right = bodyInertia(ratiosOf(kSedan), constant(kSedan, 0.001), kSedan);
  ASSERT_TRUE(found.body && right.body);
  EXPECT_GT(found.body->mass_to_pitch_inertia.stddev, 3.0 * right.body->mass_to_pitch_inertia.stddev);
  EXPECT_NEAR(found.body->mass_to_pitch_inertia.value, kPitch, 3.0 * found.body->mass_to_pitch_inertia.stddev);
}

TEST(BodyInertia, RatiosThatAreNotKnownDoNotTell) {
  EXPECT_EQ(bodyInertia(ratiosOf(kSedan), constant(kSedan, HUGE_VAL), kSedan).doubt, InertiaDoubt::kUncertain);
  EXPECT_EQ(bodyInertia(ratiosOf(kSedan), constant(kSedan, 0.5), kSedan).doubt, InertiaDoubt::kUncertain);
}

}  // namespace
}  // namespace suspension_health_monitor
