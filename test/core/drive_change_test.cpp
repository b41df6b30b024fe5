#include "suspension_health_monitor/internal/health/drive_change.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSlope = 4.0, kStddev = 0.01;  // [1/s], [m/s^2]
constexpr int kPerSide = 8;

/// Nodes at tenths, each with noise of its own.
ForceCurve curveOf(const std::function<double(double)>& law, std::mt19937_64* random = nullptr) {
  ForceCurve curve;
  std::normal_distribution<double> noise(0.0, kStddev);
  for (int i = -kPerSide; i <= kPerSide; ++i) {
    curve.at.push_back(0.1 * i);
    curve.force.push_back(law(0.1 * i) + (random != nullptr && i != 0 ? noise(*random) : 0.0));
    curve.stddev.push_back(i == 0 ? 0.0 : kStddev);
  }
  return curve;
}

double linear(double v) { return kSlope * v; }
double softInRebound(double v) { return v < 0.0 ? 0.75 * kSlope * v : kSlope * v; }

StrutEstimate estimateOf(double b1, double b0, double relative_stddev) {
  StrutEstimate estimate;
  estimate.damping_to_mass = b1;
  estimate.stiffness_to_mass = b0;
  estimate.damping_to_mass_stddev = relative_stddev * b1;
  estimate.stiffness_to_mass_stddev = relative_stddev * b0;
  estimate.doubt = EstimateDoubt::kNone;
  return estimate;
}

TEST(CurveChange, IsInReboundAloneWhereTheDamperIsSofterThere) {
  const CurveChange change = changeOf(curveOf(softInRebound), curveOf(linear));
  ASSERT_EQ(change.ranges.size(), 1u);
  const CurveChange::Range& range = change.ranges.front();
  EXPECT_DOUBLE_EQ(range.from, -0.1);
  EXPECT_DOUBLE_EQ(range.to, -0.8);
  EXPECT_TRUE(range.softer && range.to_end);
}

TEST(CurveChange, IsTheOtherWayRoundAgainstTheOtherDrive) {
  const CurveChange change = changeOf(curveOf(linear), curveOf(softInRebound));
  ASSERT_EQ(change.ranges.size(), 1u);
  EXPECT_FALSE(change.ranges.front().softer);
  EXPECT_LT(change.ranges.front().from, 0.0);
}

TEST(CurveChange, BeginsWhereALawDoes) {
  const auto stiffer = [](double d) { return kSlope * d + 2.0 * std::max(0.0, d - 0.45); };
  const CurveChange change = changeOf(curveOf(stiffer), curveOf(linear));
  ASSERT_EQ(change.ranges.size(), 1u);
  EXPECT_DOUBLE_EQ(change.ranges.front().from, 0.5);
  EXPECT_FALSE(change.ranges.front().softer);
}

TEST(CurveChange, ReachesAsFarAsBothCurves) {
  ForceCurve shorter = curveOf(linear);
  for (std::vector<double>* numbers : {&shorter.at, &shorter.force, &shorter.stddev}) {
    numbers->erase(numbers->begin(), numbers->begin() + 3);
  }
  const CurveChange change = changeOf(curveOf(softInRebound), shorter);
  ASSERT_EQ(change.ranges.size(), 1u);
  EXPECT_DOUBLE_EQ(change.ranges.front().to, -0.5);
  EXPECT_TRUE(change.ranges.front().to_end);
  EXPECT_TRUE(changeOf(curveOf(linear), {}).ranges.empty());
  EXPECT_TRUE(std::isinf(changeOf(curveOf(linear), {}).least));
}

// A change of `least` at all nodes is at the limit at one of them.
TEST(CurveChange, KnowsTheLeastChangeThatWouldShow) {
  const double least = changeOf(curveOf(linear), curveOf(linear)).least;
  EXPECT_TRUE(
      changeOf(curveOf([&](double v) { return (1.0 - 0.99 * least) * linear(v); }), curveOf(linear)).ranges.empty());
  EXPECT_FALSE(
      changeOf(curveOf([&](double v) { return (1.0 - 1.01 * least) * linear(v); }), curveOf(linear)).ranges.empty());
}

// By chance once in a thousand pairs (kFalseAlarm): of 2000 pairs more than 8 do so with a probability of 2e-4.
TEST(CurveChange, IsFoundByChanceAsSeldomAsSaid) {
  std::mt19937_64 random(1);
  int found = 0;
  for (int i = 0; i < 2000; ++i) found += !changeOf(curveOf(linear, &random), curveOf(linear, &random)).ranges.empty();
  EXPECT_LE(found, 8);
}

TEST(CurveChange, TakesTheMassOut) {
  const auto loaded = [](double v) { return linear(v) / 1.2; };
  EXPECT_EQ(changeOf(curveOf(loaded), curveOf(linear)).ranges.size(), 2u);
  EXPECT_TRUE(changeOf(curveOf(loaded), curveOf(linear), {std::log(1.2), 0.0}).ranges.empty());
}

TEST(DriveChange, IsSaidWithItsPlace) {
  const StrutCurves before{curveOf(linear), curveOf(linear)}, now{curveOf(softInRebound), curveOf(linear)};
  const DriveChange change =
      changeOf(estimateOf(0.8 * kSlope, 40.0, 0.01), now, estimateOf(kSlope, 40.0, 0.01), before, 0.3);
  // 1.645 sqrt(2) 0.01 of ln: 0.8 exp(-+0.0233) = 0.782, 0.819
  EXPECT_EQ(
      describe(change, "march.bag"),
      "damping 20.0 % below march.bag (90 %: 18.1 to 21.8 %), softer in rebound above 0.1 m/s; stiffness within -2 "
      "to +2 %");
}

TEST(DriveChange, IsNoneWhereNothingIsCertain) {
  const StrutCurves curves{curveOf(linear), curveOf(linear)};
  EXPECT_EQ(
      describe(changeOf(estimateOf(kSlope, 40.0, 0.01), curves, estimateOf(kSlope, 40.0, 0.01), curves, 0.3), "a"),
      "no certain change against a: damping within -2 to +2 %; stiffness within -2 to +2 %");
}

TEST(DriveChange, OfANumberThatTheCurveDoesNotShowIsDoubted) {
  const StrutCurves curves{curveOf(linear), curveOf(linear)};
  const DriveChange change =
      changeOf(estimateOf(0.8 * kSlope, 40.0, 0.01), curves, estimateOf(kSlope, 40.0, 0.01), curves, 0.3);
  EXPECT_NE(describe(change, "a").find("though the damper's curve shows no change"), std::string::npos);
}

TEST(DriveChange, TellsALoadFromADamper) {
  const auto loaded = [](double v) { return linear(v) / 1.25; };
  const DriveChange change = changeOf(estimateOf(kSlope / 1.25, 32.0, 0.005), {curveOf(loaded), curveOf(loaded)},
                                      estimateOf(kSlope, 40.0, 0.005), {curveOf(linear), curveOf(linear)}, 0.3);
  EXPECT_TRUE(change.damper.ranges.empty() && change.spring.ranges.empty());
  EXPECT_NE(describe(change, "a").find("body mass 25 % above"), std::string::npos) << describe(change, "a");
}

}  // namespace
}  // namespace suspension_health_monitor
