#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "suspension_health_monitor/internal/vehicle/gravity.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

/// A minute at 100 Hz of an IMU whose z axis leans by so much, that shakes.
MountClaim leaningBy(double degrees, double gain = 1.0, double gravity = kStandardGravity) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Eigen::AngleAxisd mount(degrees * M_PI / 180.0, Eigen::Vector3d::UnitX());
  MountClaim claim;
  for (int i = 0; i < 6000; ++i) {
    const Eigen::Vector3d shaking(normal(random), normal(random), 5.0 * normal(random));
    claim.add(fromSeconds(0.01 * i), gain * (mount * Eigen::Vector3d(0.0, 0.0, gravity) + shaking));
  }
  return claim;
}

std::string fault(const MountClaim& claim) {
  const auto found = claim.find(Eigen::Vector3d::UnitZ());
  return found ? describe(*found, "/imu", "unsprung_axis") : "untested";
}

TEST(MountClaim, IsSilentAboutAnUprightSensorAndAboutALeanOfARoad) {
  EXPECT_EQ(fault(leaningBy(0.0)), "");
  EXPECT_EQ(fault(leaningBy(4.0)), "");
}

TEST(MountClaim, TellsLeanAndSizeOfGravityWithTheirMeasure) {
  const auto found = leaningBy(25.0, 0.85).find(Eigen::Vector3d::UnitZ());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->lean * 180.0 / M_PI, 25.0, 3.0 * found->lean_stddev * 180.0 / M_PI);
  EXPECT_LT(found->lean_stddev, 0.01);
  // The standard error of 60 s of an axis that shakes by 5 m/s^2: 0.065.
  EXPECT_NEAR(found->size, 0.85 * kStandardGravity, 0.2);
  EXPECT_TRUE(found->isLeaning());
  EXPECT_TRUE(found->isWrongSize());
  EXPECT_NE(fault(leaningBy(25.0)).find("leans by 25 degrees"), std::string::npos) << fault(leaningBy(25.0));
  EXPECT_NE(fault(leaningBy(0.0, 1.25)).find("gain 1.25"), std::string::npos) << fault(leaningBy(0.0, 1.25));
}

TEST(MountClaim, KnowsAnIMUThatReadsInG) {
  const std::string said = fault(leaningBy(0.0, 1.0 / kStandardGravity));
  EXPECT_NE(said.find("it is in g, must be in m/s^2"), std::string::npos) << said;
}

TEST(MountClaim, NamesTheAxisThatGravityIsOn) {
  EXPECT_EQ(fault(leaningBy(90.0)), "gravity of /imu is on another axis: give unsprung_axis: -y");
  EXPECT_EQ(fault(leaningBy(180.0)), "gravity of /imu is on another axis: give unsprung_axis: -z");
}

TEST(MountClaim, DoesNotTestReadingsWithoutGravityOrOfAnAxisThatIsMissing) {
  EXPECT_EQ(fault(leaningBy(0.0, 1.0, 0.0)), "untested");
  MountClaim claim;
  for (int i = 0; i < 6000; ++i) claim.add(fromSeconds(0.01 * i), {std::nan(""), 0.0, 9.81});
  EXPECT_EQ(fault(claim), "untested");
}

TEST(MountClaim, TwoThatLeanAlikeAreOfAnInclinedStrut) {
  const auto up = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(leaningBy(20.0).find(up)->leansAs(*leaningBy(21.0).find(up)));
  EXPECT_FALSE(leaningBy(20.0).find(up)->leansAs(*leaningBy(0.0).find(up)));
}

}  // namespace
}  // namespace suspension_health_monitor
