#include "suspension_health_monitor/internal/vehicle/gravity.h"

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

namespace {

constexpr double kPart = 2.0;    // [s]
constexpr double kFewest = 5.0;  // parts: ten seconds
constexpr double kMost = 60.0;   // parts that count: two minutes
constexpr double kOtherAxis = M_PI / 4.0;

}  // namespace

void MountClaim::add(Stamp stamp, const Eigen::Vector3d& acceleration) {
  if (!acceleration.allFinite()) return;
  if (!begin_ || stamp < *begin_) begin_ = stamp, sum_.setZero(), count_ = 0.0;
  sum_ += acceleration;
  count_ += 1.0;
  if (toSeconds(stamp - *begin_) < kPart) return;
  const Eigen::Vector3d off = sum_ / count_ - mean_;
  parts_ = std::min(parts_ + 1.0, kMost);
  mean_ += off / parts_;
  scatter_ += (1.0 - 1.0 / parts_) * off.squaredNorm() - (parts_ < kMost ? 0.0 : scatter_ / kMost);
  begin_.reset();
}

std::optional<MountClaim::Finding> MountClaim::find(const Eigen::Vector3d& up) const {
  Finding found;
  found.size = mean_.norm();
  if (parts_ < kFewest || found.size < kStandardGravity / 2.0) return std::nullopt;
  found.lean = angleBetween(mean_, up);
  found.lean_stddev = std::sqrt(scatter_ / (parts_ - 1.0) / parts_) / found.size;
  mean_.cwiseAbs().maxCoeff(&found.axis);
  found.is_negative = mean_[found.axis] < 0.0;
  return found;
}

// From what rounds to kUsualLean on.
bool MountClaim::Finding::isLeaning() const { return lean > kUsualLean - 0.5 / 180.0 * M_PI + kProven * lean_stddev; }

bool MountClaim::Finding::isOnAnotherAxis() const { return lean > kOtherAxis; }

bool MountClaim::Finding::leansAs(const Finding& other) const {
  return std::abs(lean - other.lean) < kUsualLean && lean < kOtherAxis;
}

bool MountClaim::Finding::isWrongSize() const { return std::abs(size - kStandardGravity) > kUsualOffset; }

}  // namespace suspension_health_monitor
