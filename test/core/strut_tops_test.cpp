#include "suspension_health_monitor/internal/vehicle/strut_tops.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace suspension_health_monitor {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr Stamp kPeriod = std::chrono::milliseconds(10);
constexpr double kGravity = 9.81;

/// A body that heaves, sways, yaws, pitches and rolls. Its accelerations come from positions and orientations by
/// differences, not from the formula of rigid bodies.
struct MovingBody {
  double roll = 0.03, pitch = 0.05, yaw = 0.4;  // amplitudes [rad]
  double heave = 0.02;                          // [m]

  Matrix3d orientation(double t) const {  // of the body's axes in the world
    const auto turn = [](double angle, const Vector3d& axis) { return Eigen::AngleAxisd(angle, axis).matrix(); };
    return turn(yaw * std::sin(2.0 * M_PI * 0.6 * t), Vector3d::UnitZ()) *
           turn(pitch * std::sin(2.0 * M_PI * 2.1 * t), Vector3d::UnitY()) *
           turn(roll * std::sin(2.0 * M_PI * 3.4 * t + 1.0), Vector3d::UnitX());
  }
  Vector3d position(const Vector3d& point, double t) const {
    return Vector3d(0.5 * std::sin(3.0 * t), 0.2 * std::cos(5.0 * t), heave * std::sin(2.0 * M_PI * 1.6 * t)) +
           orientation(t) * point;
  }
  /// What an accelerometer and a gyro there read, in the body's axes.
  Vector3d acceleration(const Vector3d& point, double t) const {
    constexpr double h = 2e-4;
    const Vector3d second = (position(point, t + h) - 2.0 * position(point, t) + position(point, t - h)) / (h * h);
    return orientation(t).transpose() * (second + kGravity * Vector3d::UnitZ());
  }
  Vector3d angularRate(double t) const {
    constexpr double h = 1e-5;
    const Matrix3d skew = orientation(t).transpose() * (orientation(t + h) - orientation(t - h)) / (2.0 * h);
    return {skew(2, 1), skew(0, 2), skew(1, 0)};
  }
};

/// Streams: 0..5 the body's IMU, 6.. the wheels, then the sprung IMUs.
GridInstant instantOf(const Vector3d& acceleration, const Vector3d& rate, const std::vector<double>& others, int k) {
  GridInstant instant;
  instant.stamp = k * kPeriod;
  for (int i = 0; i < 3; ++i) instant.values.push_back(acceleration[i]);
  for (int i = 0; i < 3; ++i) instant.values.push_back(rate[i]);
  instant.values.insert(instant.values.end(), others.begin(), others.end());
  instant.measured.assign(instant.values.size(), true);
  return instant;
}

VehicleChannels bodyImuFor(const std::vector<Vector3d>& positions) {
  VehicleChannels channels;
  for (std::size_t i = 0; i < positions.size(); ++i) channels.struts.push_back({6 + i, {}, positions[i]});
  channels.body_imu = 0;
  return channels;
}

VehicleChannels::Strut ownImu(std::size_t unsprung, std::size_t sprung) { return {unsprung, sprung, Vector3d::Zero()}; }

/// @return z'' of every strut at the last of many instants, from a body's IMU that reads this at instant k.
template <class Acceleration, class Rate>
std::vector<double> topsAfter(const VehicleChannels& channels, const Acceleration& acceleration, const Rate& rate) {
  StrutTops tops(kPeriod, channels);
  const std::vector<double> wheels(channels.struts.size(), 0.0);
  const VehicleSample* last = nullptr;
  for (int k = 0; k < 60; ++k) last = tops.push(instantOf(acceleration(0.01 * k), rate(0.01 * k), wheels, k));
  return {last->sprung.data(), last->sprung.data() + last->sprung.size()};
}
const double kLast = 0.01 * (59 - MotionFilter(kPeriod, 1, 1).delay());

const auto kAtRest = [](double) { return Vector3d(0.0, 0.0, kGravity); };

TEST(StrutTops, PitchUpLiftsTheFrontAndRollToTheRightLiftsTheLeft) {
  const double w = 2.0 * M_PI * 2.0;
  const VehicleChannels channels = bodyImuFor({{1.3, 0.7, 0.0}, {-1.5, -0.6, 0.0}});
  // Positive pitch, about the axis to the left, turns the nose down (REP 103).
  const std::vector<double> pitching =
      topsAfter(channels, kAtRest, [&](double t) { return Vector3d(0.0, 0.01 * std::sin(w * t), 0.0); });
  const double alpha = 0.01 * w * std::cos(w * kLast);
  EXPECT_NEAR(pitching[0], kGravity - 1.3 * alpha, 3e-4);
  EXPECT_NEAR(pitching[1], kGravity + 1.5 * alpha, 3e-4);
  const std::vector<double> rolling =
      topsAfter(channels, kAtRest, [&](double t) { return Vector3d(0.01 * std::sin(w * t), 0.0, 0.0); });
  EXPECT_NEAR(rolling[0], kGravity + 0.7 * alpha, 3e-4);
  EXPECT_NEAR(rolling[1], kGravity - 0.6 * alpha, 3e-4);
}

TEST(StrutTops, OfASteadyTurnFeelsTheCentripetalAcceleration) {
  const Vector3d rate(0.3, -0.2, 0.5), position(1.2, 0.4, -0.6);
  const std::vector<double> tops = topsAfter(bodyImuFor({position}), kAtRest, [&](double) { return rate; });
  EXPECT_NEAR(tops[0], kGravity + rate.cross(rate.cross(position)).z(), 1e-10);
}

TEST(StrutTops, PassGravityWhereverTheyAre) {
  const auto still = [](double) { return Vector3d::Zero().eval(); };
  const std::vector<double> tops = topsAfter(bodyImuFor({{1.0, 2.0, 3.0}, {-1.0, 0.5, 0.0}}), kAtRest, still);
  EXPECT_NEAR(tops[0], kGravity, 1e-12);
  EXPECT_NEAR(tops[1], kGravity, 1e-12);
}

// The body's IMU anywhere on the body, mounted askew.
TEST(StrutTops, AreThoseOfTheMovingBody) {
  const MovingBody body;
  const std::vector<Vector3d> tops{{1.3, 0.7, 0.2}, {1.3, -0.7, 0.2}, {-1.5, 0.6, 0.3}, {-1.5, -0.6, 0.3}};
  const Vector3d imu(-0.4, 0.25, 0.6);
  VehicleChannels channels = bodyImuFor({});
  for (std::size_t i = 0; i < tops.size(); ++i) channels.struts.push_back({6 + i, {}, tops[i] - imu});
  channels.body_mount = (Eigen::AngleAxisd(0.9, Vector3d::UnitZ()) * Eigen::AngleAxisd(M_PI - 0.3, Vector3d::UnitX()) *
                         Eigen::AngleAxisd(0.2, Vector3d::UnitY()))
                            .matrix();
  StrutTops vehicle(kPeriod, channels);
  int instants = 0;
  for (int k = 0; k < 300; ++k) {
    const double t = 0.01 * k;
    const Matrix3d to_imu = channels.body_mount.transpose();
    const VehicleSample* instant = vehicle.push(
        instantOf(to_imu * body.acceleration(imu, t), to_imu * body.angularRate(t), {1.0, 2.0, 3.0, 4.0}, k));
    if (instant == nullptr) continue;
    ++instants;
    for (std::size_t i = 0; i < tops.size(); ++i) {
      EXPECT_NEAR(instant->sprung[static_cast<Eigen::Index>(i)],
                  body.acceleration(tops[i], toSeconds(instant->stamp)).z(), 3e-3)
          << i;
      EXPECT_NEAR(instant->unsprung[static_cast<Eigen::Index>(i)], 1.0 + static_cast<double>(i), 1e-12);
    }
  }
  EXPECT_EQ(instants, 300 - 2 * vehicle.delay());
}

// Where the filter no longer passes all, an IMU at the strut and the one of the body are still told alike.
TEST(StrutTops, OfOneMotionAgreeHoweverTheyAreMeasuredUpToHalfTheSamplingRate) {
  const Vector3d position(1.3, -0.7, 0.0);
  for (const double frequency : {5.0, 20.0, 30.0, 36.0, 45.0}) {
    VehicleChannels channels;
    channels.body_imu = 0;
    channels.struts = {{6, {}, position}, {6, 7, position}};
    channels.known_forces = {7};
    StrutTops tops(kPeriod, channels);
    const double w = 2.0 * M_PI * frequency;
    for (int k = 0; k < 200; ++k) {
      const double t = 0.01 * k;
      const Vector3d alpha(2.0 * std::cos(w * t), -3.0 * std::sin(w * t), 0.0);
      const Vector3d rate(2.0 * std::sin(w * t) / w, 3.0 * std::cos(w * t) / w, 0.0);
      const double top = kGravity + std::sin(w * t) + alpha.cross(position).z();
      const VehicleSample* instant = tops.push(instantOf({0.0, 0.0, kGravity + std::sin(w * t)}, rate, {0.0, top}, k));
      if (instant == nullptr) continue;
      // 1e-4 of the rate in angle per sample, by the lever arm.
      EXPECT_NEAR(instant->sprung[0], instant->sprung[1], 1e-4 * (3.0 / w) / 0.01 * (1.3 + 0.7)) << frequency;
      EXPECT_EQ(instant->forces[0], instant->sprung[1]);
    }
  }
}

// Own IMUs' readings lie between the wheels': whose is whose is told by the streams.
TEST(StrutTops, KnowWhatWheelsDidBeforeTheFilter) {
  VehicleChannels channels;
  channels.body_imu = 0;
  channels.struts = {{6, {}, Vector3d(1.0, 0.0, 0.0)}, {7, 9, Vector3d::Zero()}, {8, {}, Vector3d(-1.0, 0.0, 0.0)}};
  StrutTops tops(kPeriod, channels);
  const auto wheel = [](int strut, int k) { return strut + (k % 2 == 0 ? 0.5 : -0.5); };
  int instants = 0;
  for (int k = 0; k < 100; ++k) {
    const VehicleSample* instant = tops.push(
        instantOf({0.0, 0.0, kGravity}, Vector3d::Zero(), {wheel(1, k), wheel(2, k), wheel(3, k), kGravity}, k));
    if (instant == nullptr) continue;
    ++instants;
    ASSERT_EQ(instant->unfiltered.size(), 3);
    const int then = static_cast<int>(instant->stamp / kPeriod);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(instant->unfiltered[i], wheel(i + 1, then));
      EXPECT_NEAR(instant->unsprung[i], i + 1.0, 1e-3);  // nothing of half the sampling rate passes
    }
  }
  EXPECT_GT(instants, 10);
  EXPECT_EQ(tops.lowPass().size(), static_cast<std::size_t>(2 * tops.delay() + 1));
}

TEST(StrutTops, AreTheReadingsThemselvesWhereEveryStrutHasItsOwn) {
  VehicleChannels channels;
  channels.struts = {ownImu(0, 1), ownImu(2, 3)};
  channels.known_forces = {4};
  StrutTops tops(kPeriod, channels);
  GridInstant reading{Stamp(7), {1.0, 2.0, 3.0, 4.0, 5.0}, std::vector<bool>(5, true)};
  const VehicleSample* instant = tops.push(reading);
  ASSERT_NE(instant, nullptr);
  EXPECT_EQ(tops.delay(), 0);
  EXPECT_EQ(instant->stamp, Stamp(7));
  EXPECT_EQ(instant->unsprung, Eigen::Vector2d(1.0, 3.0));
  EXPECT_EQ(instant->unfiltered.size(), 0);
  EXPECT_TRUE(tops.lowPass().empty());
  EXPECT_EQ(instant->sprung, Eigen::Vector2d(2.0, 4.0));
  ASSERT_EQ(instant->forces.size(), 1);
  EXPECT_EQ(instant->forces[0], 5.0);
}

TEST(StrutTops, RefuseAStrutThatNothingTellsOfAndMoreThanAVehicleHas) {
  VehicleChannels channels;
  channels.struts = {ownImu(0, 1), {2, {}, Vector3d::Zero()}};
  EXPECT_THROW(StrutTops(kPeriod, channels), std::invalid_argument);
  channels.struts.assign(kMostStruts + 1, ownImu(0, 1));
  EXPECT_THROW(StrutTops(kPeriod, channels), std::invalid_argument);
}

}  // namespace
}  // namespace suspension_health_monitor
