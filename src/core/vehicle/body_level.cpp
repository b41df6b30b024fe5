#include "suspension_health_monitor/internal/vehicle/body_level.h"

#include <Eigen/Geometry>
#include <cmath>

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLeastGravity = 5.0;  // [m/s^2]: half of it, which no offset is
// What of the vertical a lean may take, as much as the coupling may be in doubt by: 14 degrees, a road of 25 %.
constexpr double kMostTaken = 0.03;

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

bool BodyLevel::isTurned() const { return 1.0 - std::cos(lean_) > kMostTaken; }

}  // namespace suspension_health_monitor
