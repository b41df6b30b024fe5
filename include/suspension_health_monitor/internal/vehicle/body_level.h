#pragma once

#include <Eigen/Core>
#include <vector>

namespace suspension_health_monitor {

/// How the IMU of a body is turned against upright, from the gravity in its readings.
class BodyLevel {
 public:
  /// As it is given: nothing to turn.
  BodyLevel() = default;

  /// @param accelerations  of a while, in the IMU's axes [m/s^2]. Their medians are gravity, if they are as large as
  /// that; an IMU that takes gravity off tells nothing.
  explicit BodyLevel(const std::vector<Eigen::Vector3d>& accelerations);

  /// @return angle between the IMU's z axis and upright [rad].
  double lean() const { return lean_; }

  /// @return true if the lean is more than that of a road, of the load or of a careful hand, which cannot be told from
  /// each other and do no harm.
  bool isTurned() const;

  /// @return what turns the IMU's axes upright, by the smallest angle; the identity unless isTurned().
  Eigen::Matrix3d mount() const { return mount_; }

 private:
  double lean_ = 0.0;
  Eigen::Matrix3d mount_ = Eigen::Matrix3d::Identity();
};

}  // namespace suspension_health_monitor
