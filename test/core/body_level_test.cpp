#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/gravity.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"

namespace suspension_health_monitor {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d turn(double degrees, const Vector3d& axis) {
  return Eigen::AngleAxisd(degrees / 180.0 * M_PI, axis.normalized()).toRotationMatrix();
}

/// Readings of an IMU that is turned against the body by this, on a rough road.
std::vector<Vector3d> drive(const Matrix3d& imu_in_body, double gravity = 9.81) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> shaking(0.0, 1.5);
  std::vector<Vector3d> readings;
  for (int k = 0; k < 4000; ++k)
    readings.emplace_back(imu_in_body.transpose() *
                          Vector3d(shaking(engine), shaking(engine), gravity + shaking(engine)));
  return readings;
}

// The median of 4000 readings is within 1.5 * 1.25 / sqrt(4000) of the mean, 0.03 m/s^2, in each axis.
constexpr double kMedianOff = 5.0 * 0.03 / 9.81;  // [rad]

TEST(BodyLevel, TurnsAnIMUThatLeansAnyhowUpright) {
  for (const Vector3d& axis : {Vector3d(1.0, 0.0, 0.0), Vector3d(0.3, -1.0, 0.0), Vector3d(-1.0, 0.4, 0.8)})
    for (const double degrees : {8.0, 25.0, 90.0, 135.0, 180.0}) {
      const Matrix3d imu_in_body = turn(degrees, axis);
      const BodyLevel level(drive(imu_in_body));
      const Vector3d up_in_imu = imu_in_body.transpose() * Vector3d::UnitZ();
      EXPECT_NEAR(level.lean, std::acos(up_in_imu.z()), kMedianOff) << degrees;
      EXPECT_LT((level.mount * up_in_imu - Vector3d::UnitZ()).norm(), kMedianOff) << degrees;
      EXPECT_NEAR(level.mount.determinant(), 1.0, 1e-10);
      EXPECT_LT((level.mount * level.mount.transpose() - Matrix3d::Identity()).norm(), 1e-10);
    }
}

TEST(BodyLevel, LeavesWhatARoadMayBe) {
  const BodyLevel level(drive(turn(3.0, {0.0, 1.0, 0.0})));
  EXPECT_NEAR(level.lean, 3.0 / 180.0 * M_PI, kMedianOff);
  EXPECT_EQ(level.mount, Matrix3d::Identity());
}

TEST(BodyLevel, SaysNothingOfAnIMUThatTakesGravityOff) {
  for (const double offset : {0.0, 0.8}) {
    const BodyLevel level(drive(turn(90.0, {0.0, 1.0, 0.0}), offset));
    EXPECT_EQ(level.lean, 0.0);
    EXPECT_EQ(level.mount, Matrix3d::Identity());
  }
}

TEST(BodyLevel, KnowsAnIMUThatReadsInG) {
  const Matrix3d imu_in_body = turn(30.0, {0.0, 1.0, 0.0});
  std::vector<Vector3d> readings = drive(imu_in_body);
  for (Vector3d& reading : readings) reading /= kStandardGravity;
  const BodyLevel level(readings);
  EXPECT_NEAR(level.gain, 1.0 / kStandardGravity, 0.01 / kStandardGravity);
  EXPECT_NEAR(level.lean, 30.0 / 180.0 * M_PI, kMedianOff);
}

TEST(BodyLevel, IsNotMovedByWrongReadings) {
  std::vector<Vector3d> readings = drive(turn(30.0, {0.0, 1.0, 0.0}));
  for (std::size_t k = 0; k < readings.size(); k += 20) readings[k] = Vector3d(1e60, -1e60, 1e9);
  EXPECT_NEAR(BodyLevel(readings).lean, 30.0 / 180.0 * M_PI, 0.1 * 1.5 / 9.81 + kMedianOff);
}

constexpr double kPeriod = 0.01;

/// Of one strut whose top the body's IMU tells.
VehicleStreams streamsAt(const Vector3d& position) {
  VehicleLayout layout;
  layout.body_imu = "/imu";
  VehicleLayout::Strut strut;
  strut.name = "strut";
  strut.unsprung_imu = "/wheel";
  strut.position = std::array<double, 3>{position.x(), position.y(), position.z()};
  layout.struts.push_back(strut);
  return VehicleStreams(layout);
}

// A body that heaves, and pitches about its left axis. Its IMU, with the positions in its own axes, leans.
// pulls_away(t): its acceleration forward.
std::vector<VehicleSample> topOf(
    const Matrix3d& imu_in_body, const Vector3d& top, int instants,
    const std::function<double(double)>& pulls_away = [](double) { return 0.0; }) {
  std::vector<VehicleSample> samples;
  VehicleGrid grid(kPeriod, streamsAt(imu_in_body.transpose() * top), {},
                   [&](const VehicleSample& sample) { samples.push_back(sample); });
  for (int k = 0; k < instants; ++k) {
    const double t = kPeriod * k, w = 2.0 * M_PI * 1.5;
    const Vector3d acceleration = imu_in_body.transpose() * Vector3d(pulls_away(t), 0.0, 9.81 + std::sin(w * t));
    const Vector3d rate = imu_in_body.transpose() * Vector3d(0.0, 0.05 * std::cos(w * t), 0.0);
    const Stamp stamp = fromSeconds(100.0) + k * fromSeconds(kPeriod);
    grid.push(0, stamp, {acceleration.x(), acceleration.y(), acceleration.z(), rate.x(), rate.y(), rate.z()});
    grid.push(1, stamp, {std::sin(3.0 * w * t)});
  }
  grid.finish();
  return samples;
}

TEST(VehicleGrid, GivesTheSameTopsHoweverTheBodysIMULeans) {
  const Vector3d top(1.2, 0.5, -0.3);
  const std::vector<VehicleSample> upright = topOf(Matrix3d::Identity(), top, 1500);
  ASSERT_GT(upright.size(), 1400U);
  for (const double degrees : {25.0, 90.0, 180.0}) {
    const std::vector<VehicleSample> leaning = topOf(turn(degrees, {0.2, 1.0, 0.0}), top, 1500);
    ASSERT_EQ(leaning.size(), upright.size());
    for (std::size_t k = 0; k < upright.size(); ++k) {
      EXPECT_EQ(leaning[k].stamp, upright[k].stamp);
      ASSERT_NEAR(leaning[k].sprung[0], upright[k].sprung[0], 1e-9) << degrees << ' ' << k;
    }
  }
}

// It stands for a while, and pulls away within the seconds that tell the level; or it pulls away and brakes all the
// time.
TEST(VehicleGrid, TakesNoPullingAwayForALean) {
  const Vector3d top(1.2, 0.5, -0.3);
  for (const double degrees : {0.0, 25.0}) {
    const Matrix3d mount = turn(degrees, {0.2, 1.0, 0.0});
    const std::vector<VehicleSample> still = topOf(mount, top, 4000);
    for (const double stands : {1.0, 3.0, 6.0}) {
      const std::vector<VehicleSample> leaves =
          topOf(mount, top, 4000, [&](double t) { return t > stands && t < stands + 7.0 ? 2.0 : 0.0; });
      ASSERT_EQ(leaves.size(), still.size());
      for (std::size_t k = 0; k < still.size(); ++k)
        ASSERT_NEAR(leaves[k].sprung[0], still[k].sprung[0], 0.01) << degrees << ' ' << stands << ' ' << k;
    }
  }
  const std::vector<VehicleSample> upright = topOf(Matrix3d::Identity(), top, 4000);
  const std::vector<VehicleSample> always =
      topOf(Matrix3d::Identity(), top, 4000, [](double t) { return std::fmod(t, 12.0) < 6.0 ? 2.0 : -2.0; });
  ASSERT_EQ(always.size(), upright.size());
  for (std::size_t k = 0; k < upright.size(); ++k) ASSERT_NEAR(always[k].sprung[0], upright[k].sprung[0], 0.01) << k;
}

// A drive that ends before gravity is known well is not lost.
TEST(VehicleGrid, LeadsOnWhatWaitsAtTheEnd) {
  EXPECT_GT(topOf(turn(40.0, {0.0, 1.0, 0.0}), {1.0, 0.0, 0.0}, 500).size(), 400U);
}

}  // namespace
}  // namespace suspension_health_monitor
