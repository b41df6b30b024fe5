#include "suspension_health_monitor/internal/health/corner_comparison.h"

#include <gtest/gtest.h>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

using Corners = std::array<CornerState, kNumCorners>;
enum { kFrontLeft, kFrontRight, kRearLeft, kRearRight };

// Front and rear struts of a car differ; so do their baselines.
Corners healthyCorners() {
  Corners corners;
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    auto& [estimate, healthy] = corners[i];
    estimate.doubt = EstimateDoubt::kNone;
    healthy.damping_to_mass = estimate.damping_to_mass = i < 2 ? 6.0 : 4.0;
    healthy.stiffness_to_mass = estimate.stiffness_to_mass = i < 2 ? 63.3 : 50.0;
    estimate.damping_to_mass_stddev = 0.01 * estimate.damping_to_mass;
    estimate.stiffness_to_mass_stddev = 0.01 * estimate.stiffness_to_mass;
  }
  return corners;
}

void load(CornerState& corner, double mass_ratio) {
  corner.estimate.damping_to_mass /= mass_ratio;
  corner.estimate.stiffness_to_mass /= mass_ratio;
}

void forgetBaselines(Corners& corners) {
  for (CornerState& corner : corners) corner.healthy = {};
}

TEST(CornerComparison, HealthyCornersAreAlike) {
  const CornerComparisonReport report = compareCorners(healthyCorners());
  EXPECT_EQ(report.level, HealthLevel::kOk);
  EXPECT_EQ(describe(report), "all corners alike");
  for (const CornerVerdict verdict : report.verdicts) EXPECT_EQ(verdict, CornerVerdict::kAlike);
}

TEST(CornerComparison, NamesTheOneCornerWhoseDamperIsWornWhicheverItIs) {
  for (std::size_t worn = 0; worn < kNumCorners; ++worn) {
    Corners corners = healthyCorners();
    corners[worn].estimate.damping_to_mass *= 0.72;
    const CornerComparisonReport report = compareCorners(corners);
    EXPECT_EQ(report.level, HealthLevel::kWarn);
    EXPECT_EQ(describe(report),
              std::string(kCornerNames[worn]) + " damping 28 % below the other corners (25 to 31 %): damage");
    EXPECT_NEAR(*report.damping_deviation[worn], -0.28, 1e-12);
    EXPECT_NEAR(*report.stiffness_deviation[worn], 0.0, 1e-12);
    for (std::size_t i = 0; i < kNumCorners; ++i)
      EXPECT_EQ(report.verdicts[i], i == worn ? CornerVerdict::kDamper : CornerVerdict::kAlike);
  }
}

TEST(CornerComparison, LoadMovesAllCornersOrAnAxleAndIsNoDamage) {
  Corners all = healthyCorners();
  for (CornerState& corner : all) load(corner, 1.25);
  EXPECT_EQ(compareCorners(all).level, HealthLevel::kOk);
  EXPECT_EQ(describe(compareCorners(all)), "all corners stiffness/mass 20 % down: payload");
  Corners rear = healthyCorners();
  load(rear[kRearLeft], 1.25);
  load(rear[kRearRight], 1.25);
  const CornerComparisonReport report = compareCorners(rear);
  EXPECT_EQ(report.level, HealthLevel::kOk);
  EXPECT_EQ(describe(report), "rear_left, rear_right stiffness/mass 20 % down: payload");
  EXPECT_EQ(report.verdicts[kRearLeft], CornerVerdict::kLoad);
  EXPECT_EQ(report.verdicts[kFrontLeft], CornerVerdict::kAlike);
}

TEST(CornerComparison, TellsDamperFromSpringUnderLoad) {
  for (const double mass_ratio : {0.8, 1.0, 1.25}) {
    Corners damper = healthyCorners(), spring = healthyCorners();
    for (const int corner : {kRearLeft, kRearRight}) {
      load(damper[corner], mass_ratio);
      load(spring[corner], mass_ratio);
    }
    damper[kRearLeft].estimate.damping_to_mass *= 0.7;
    spring[kRearLeft].estimate.stiffness_to_mass *= 0.7;
    EXPECT_EQ(compareCorners(damper).verdicts[kRearLeft], CornerVerdict::kDamper) << mass_ratio;
    EXPECT_EQ(compareCorners(spring).verdicts[kRearLeft], CornerVerdict::kSpring) << mass_ratio;
    EXPECT_EQ(compareCorners(spring).verdicts[kFrontRight], CornerVerdict::kAlike) << mass_ratio;
  }
}

TEST(CornerComparison, TheSizeOfADamageIsFreeOfTheLoadOnThatWheel) {
  for (const double mass_ratio : {0.9, 1.0, 1.12}) {
    Corners damper = healthyCorners(), spring = healthyCorners();
    damper[kRearLeft].estimate.damping_to_mass *= 0.7;
    spring[kRearLeft].estimate.stiffness_to_mass *= 0.7;
    for (Corners* corners : {&damper, &spring}) {
      load((*corners)[kRearLeft], mass_ratio);
      const CornerComparisonReport report = compareCorners(*corners);
      ASSERT_EQ(report.damages.size(), 1u);
      EXPECT_EQ(report.verdicts[kRearLeft], corners == &damper ? CornerVerdict::kDamper : CornerVerdict::kSpring);
      EXPECT_NEAR(report.damages[0].change, -0.3, 1e-12);
    }
  }
}

TEST(CornerComparison, AWeakerSpringUnderASmallerLoadIsNoStrongerDamper) {
  Corners corners = healthyCorners();
  corners[kFrontRight].estimate.stiffness_to_mass *= 0.8;
  load(corners[kFrontRight], 0.88);  // damping 14 % above, stiffness 9 % below
  const CornerComparisonReport report = compareCorners(corners);
  EXPECT_EQ(report.verdicts[kFrontRight], CornerVerdict::kSpring);
  Corners replaced = healthyCorners();
  replaced[kFrontRight].estimate.damping_to_mass *= 1.4;  // no load is so small
  EXPECT_EQ(compareCorners(replaced).verdicts[kFrontRight], CornerVerdict::kDamper);
}

TEST(CornerComparison, SmallDifferencesOfTheOthersHideNoDamage) {
  Corners corners = healthyCorners();
  corners[kFrontRight].estimate.damping_to_mass *= 1.02;
  corners[kRearLeft].estimate.damping_to_mass *= 1.01;
  corners[kRearRight].estimate.damping_to_mass *= 1.03;
  corners[kFrontLeft].estimate.damping_to_mass *= 0.85;
  EXPECT_EQ(compareCorners(corners).verdicts[kFrontLeft], CornerVerdict::kDamper);
}

TEST(CornerComparison, WarmDampersAccuseNone) {
  Corners corners = healthyCorners();
  for (CornerState& corner : corners) corner.estimate.damping_to_mass *= 0.7;
  const CornerComparisonReport report = compareCorners(corners);
  EXPECT_EQ(report.level, HealthLevel::kOk);
  EXPECT_NE(describe(report).find("warm or worn dampers"), std::string::npos) << describe(report);
}

TEST(CornerComparison, AnUncertainEstimateAccusesNone) {
  Corners corners = healthyCorners();
  corners[kFrontLeft].estimate.damping_to_mass *= 0.72;
  corners[kFrontLeft].estimate.damping_to_mass_stddev =
      0.2 * corners[kFrontLeft].estimate.damping_to_mass;  // ln 0.72 is 1.6 of it
  EXPECT_EQ(compareCorners(corners).level, HealthLevel::kOk);
}

TEST(CornerComparison, AnUncertainBaselineAccusesNone) {
  Corners corners = healthyCorners();
  corners[kFrontLeft].estimate.damping_to_mass *= 0.72;
  corners[kFrontLeft].healthy.damping_to_mass_stddev = 0.2 * *corners[kFrontLeft].healthy.damping_to_mass;
  EXPECT_EQ(compareCorners(corners).level, HealthLevel::kOk);
}

TEST(CornerComparison, ThreeCornersAreEnoughAndTwoAreNot) {
  Corners corners = healthyCorners();
  corners[kFrontLeft].estimate.damping_to_mass *= 0.65;
  corners[kRearRight].estimate.doubt = EstimateDoubt::kNoRows;
  const CornerComparisonReport three = compareCorners(corners);
  EXPECT_EQ(three.verdicts[kFrontLeft], CornerVerdict::kDamper);
  EXPECT_EQ(three.verdicts[kFrontRight], CornerVerdict::kAlike);
  EXPECT_EQ(three.verdicts[kRearRight], CornerVerdict::kCannotTell);
  corners[kRearLeft].estimate.doubt = EstimateDoubt::kNoRows;
  const CornerComparisonReport two = compareCorners(corners);
  EXPECT_EQ(two.level, HealthLevel::kStale);
  EXPECT_EQ(describe(two), "cannot tell: 2 of 4 corners have a valid estimate, 3 are needed");
}

// Else a corner that is damaged and goes silent would look repaired.
TEST(CornerComparison, ThreeThatAreAlikeProveNothingOfTheFourth) {
  for (const bool with_baselines : {true, false}) {
    Corners corners = healthyCorners();
    if (!with_baselines) forgetBaselines(corners);
    corners[kRearLeft].estimate.doubt = EstimateDoubt::kNoRows;
    const CornerComparisonReport report = compareCorners(corners);
    EXPECT_EQ(report.level, HealthLevel::kStale);
    EXPECT_NE(describe(report).find("no valid estimate of rear_left"), std::string::npos) << describe(report);
    EXPECT_EQ(describe(report).find("all corners"), std::string::npos) << describe(report);
  }
}

TEST(CornerComparison, WithoutBaselinesTheWheelsOfAnAxleAreCompared) {
  Corners corners = healthyCorners();
  forgetBaselines(corners);
  EXPECT_EQ(describe(compareCorners(corners)), "left and right alike (no baseline)");
  corners[kRearRight].estimate.damping_to_mass *= 0.7;
  const CornerComparisonReport report = compareCorners(corners);
  EXPECT_EQ(report.verdicts[kRearRight], CornerVerdict::kDamper);
  EXPECT_EQ(report.verdicts[kRearLeft], CornerVerdict::kAlike);
  EXPECT_EQ(describe(report), "rear_right damping 30 % below rear_left (27 to 33 %, no baseline): damage");
}

TEST(CornerComparison, ABaselineOfADamagedVehicleHidesNoDamage) {
  Corners corners = healthyCorners();
  for (CornerState& corner : corners) corner.healthy.learned = true;
  EXPECT_EQ(describe(compareCorners(corners)), "all corners alike");
  *corners[kRearRight].healthy.damping_to_mass *= 0.7;
  corners[kRearRight].estimate.damping_to_mass *= 0.7;
  const CornerComparisonReport report = compareCorners(corners);
  EXPECT_EQ(report.level, HealthLevel::kWarn);
  EXPECT_EQ(report.verdicts[kRearRight], CornerVerdict::kDamper);
  EXPECT_NE(describe(report).find("rear_right damping 30 % below rear_left"), std::string::npos) << describe(report);
  for (CornerState& corner : corners) corner.healthy.learned = false;  // nominal values are what somebody wants
  EXPECT_EQ(describe(compareCorners(corners)), "all corners alike");
}

}  // namespace
}  // namespace suspension_health_monitor
