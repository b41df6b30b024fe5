#include "suspension_health_monitor/internal/vehicle/body_level.h"

#include <Eigen/Geometry>
#include <cmath>

#include "suspension_health_monitor/internal/pi.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLeastGravity = 5.0;  // [m/s^2]: half of it, which no offset is
// A road of 9 %: steeper ones are rare. An IMU that leans by less reads so little of the gravity that pitch and roll
// turn that b0 is wrong by 2 %.
constexpr double kSteepestRoad = 5.0 / 180.0 * kPi;

}  // namespace

BodyLevel::BodyLevel(const std::vector<Eigen::Vector3d>& accelerations) {
  Eigen::Vector3d gravity;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> readings;
    for (const Eigen::Vector3d& acceleration : accelerations) readings.push_back(acceleration[axis]);
    gravity[axis] = median(std::move(readings));
  }
  if (!(gravity.norm() >= kLeastGravity)) return;
  lean_ = std::atan2(gravity.head<2>().norm(), gravity.z());
  if (isTurned()) mount_ = Eigen::Quaterniond::FromTwoVectors(gravity, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

bool BodyLevel::isTurned() const { return lean_ > kSteepestRoad; }

}  // namespace suspension_health_monitor
