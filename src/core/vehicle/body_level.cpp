#include "suspension_health_monitor/internal/vehicle/body_level.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr std::ptrdiff_t kParts = 5;  // of the while: of ten seconds, shorter ones than braking takes

using Readings = std::vector<Eigen::Vector3d>;

Eigen::Vector3d medianOf(Readings::const_iterator begin, Readings::const_iterator end) {
  Eigen::Vector3d medians;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> readings;
    for (auto reading = begin; reading != end; ++reading) readings.push_back((*reading)[axis]);
    medians[axis] = median(std::move(readings));
  }
  return medians;
}

}  // namespace

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

BodyLevel::BodyLevel(const Readings& accelerations) {
  const auto begin = accelerations.begin(), end = accelerations.end();
  std::array<Eigen::Vector3d, kParts> parts;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  for (std::ptrdiff_t i = 0; i < kParts; ++i) {
    Eigen::Vector3d& part = parts[static_cast<std::size_t>(i)];
    part = medianOf(begin + (end - begin) * i / kParts, begin + (end - begin) * (i + 1) / kParts);
    gravity += part / kParts;
  }
  if (!(gravity.norm() >= kStandardGravity / 2.0)) return;  // which no offset is
  if (std::abs(gravity.norm() - kStandardGravity) > kUsualOffset) gain_ = gravity.norm() / kStandardGravity;
  lean_ = angleBetween(gravity, Eigen::Vector3d::UnitZ());
  is_steady_ = std::all_of(parts.begin(), parts.end(), [&](const Eigen::Vector3d& part) {
    return angleBetween(part, gravity) <= 0.5 * kUsualLean;
  });
  if (isTurned()) mount_ = Eigen::Quaterniond::FromTwoVectors(gravity, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

bool BodyLevel::isTurned() const { return lean_ > kUsualLean; }

}  // namespace suspension_health_monitor
