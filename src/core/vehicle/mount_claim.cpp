#include "suspension_health_monitor/internal/vehicle/mount_claim.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/statistics.h"
#include "suspension_health_monitor/internal/vehicle/body_level.h"

namespace suspension_health_monitor {
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

bool MountClaim::Finding::isLeaning() const { return lean > kUsualLean + kProven * lean_stddev; }

bool MountClaim::Finding::isOnAnotherAxis() const { return lean > kOtherAxis; }

bool MountClaim::Finding::leansAs(const Finding& other) const {
  return std::abs(lean - other.lean) < kUsualLean && lean < kOtherAxis;
}

bool MountClaim::Finding::isWrongSize() const { return std::abs(size - kStandardGravity) > kUsualOffset; }

}  // namespace suspension_health_monitor
