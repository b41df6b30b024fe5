#include "suspension_health_monitor/internal/vehicle/gravity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>

namespace suspension_health_monitor {
namespace {

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

// Beyond half of gravity, where no offset reaches, or in g.
bool isGravity(double size) { return size >= kStandardGravity / 2.0 || readsInG(size); }

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

BodyLevel::BodyLevel(const Readings& accelerations) {
  const auto begin = accelerations.begin(), end = accelerations.end();
  std::array<Eigen::Vector3d, kVehicleTuning.fewest_parts> parts;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  for (std::ptrdiff_t i = 0; i < kVehicleTuning.fewest_parts; ++i) {
    parts[i] = medianOf(begin + (end - begin) * i / kVehicleTuning.fewest_parts,
                        begin + (end - begin) * (i + 1) / kVehicleTuning.fewest_parts);
    gravity += parts[i] / kVehicleTuning.fewest_parts;
  }
  if (!isGravity(gravity.norm())) return;
  if (std::abs(gravity.norm() - kStandardGravity) > kLargestOffset) gain = gravity.norm() / kStandardGravity;
  lean = angleBetween(gravity, Eigen::Vector3d::UnitZ());
  is_steady = std::all_of(parts.begin(), parts.end(), [&](const Eigen::Vector3d& part) {
    return angleBetween(part, gravity) <= 0.5 * kVehicleTuning.largest_lean;
  });
  if (isTurned()) mount = Eigen::Quaterniond::FromTwoVectors(gravity, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

bool MountClaim::add(Stamp stamp, const Eigen::Vector3d& acceleration) {
  if (!acceleration.allFinite()) return false;
  if (!begin_ || stamp < *begin_) begin_ = stamp, sum_.setZero(), count_ = 0.0;
  sum_ += acceleration;
  count_ += 1.0;
  if (toSeconds(stamp - *begin_) < kVehicleTuning.part) return false;
  const Eigen::Vector3d off = sum_ / count_ - mean_;
  parts_ = std::min(parts_ + 1.0, kVehicleTuning.most_parts);
  mean_ += off / parts_;
  scatter_ += (1.0 - 1.0 / parts_) * off.squaredNorm() -
              (parts_ < kVehicleTuning.most_parts ? 0.0 : scatter_ / kVehicleTuning.most_parts);
  begin_.reset();
  return true;
}

std::optional<MountClaim::Finding> MountClaim::find(const Eigen::Vector3d& up) const {
  Finding found;
  found.size = mean_.norm();
  if (!isKnown() || !isGravity(found.size)) return std::nullopt;
  found.lean = angleBetween(mean_, up);
  found.lean_stddev = std::sqrt(scatter_ / (parts_ - 1.0) / parts_) / found.size;
  mean_.cwiseAbs().maxCoeff(&found.axis);
  found.is_negative = mean_[found.axis] < 0.0;
  return found;
}

std::string_view MountClaim::Finding::name() const {
  return std::array<std::string_view, 6>{"x", "y", "z", "-x", "-y", "-z"}[axis + (is_negative ? 3 : 0)];
}

}  // namespace suspension_health_monitor
