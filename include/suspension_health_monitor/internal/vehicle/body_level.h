#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace suspension_health_monitor {

/// Lean of a road of 9 %, steeper ones are rare, of the load or of a careful hand [rad]. An IMU that leans by less
/// reads so little of the gravity that pitch and roll turn that b0 is wrong by 2 %.
inline constexpr double kUsualLean = 5.0 / 180.0 * M_PI;

/// @return the angle between two directions [rad].
double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// How the IMU of a body is turned against upright, from the gravity in its readings.
class BodyLevel {
 public:
  /// As it is given: nothing to turn.
  BodyLevel() = default;

  /// @param accelerations  of a while, in the IMU's axes [m/s^2]. The mean of a few medians is gravity, if it is as
  /// large as that: a vehicle brakes as much as it pulls away. An IMU that takes gravity off tells nothing.
  explicit BodyLevel(const std::vector<Eigen::Vector3d>& accelerations);

  /// @return angle between the IMU's z axis and upright [rad].
  double lean() const { return lean_; }

  /// @return true if the lean is more than that of a road, of the load or of a careful hand, which cannot be told from
  /// each other and do no harm.
  bool isTurned() const;

  /// @return of the accelerations, by the size of gravity in them; 1 unless it is off by more than an offset makes.
  double gain() const { return gain_; }

  /// @return true if gravity was the same in all parts of the while, but for half of that: else the vehicle braked,
  /// pulled away or went round a bend.
  bool isSteady() const { return is_steady_; }

  /// @return what turns the IMU's axes upright, by the smallest angle; the identity unless isTurned().
  Eigen::Matrix3d mount() const { return mount_; }

 private:
  double lean_ = 0.0, gain_ = 1.0;
  bool is_steady_ = true;
  Eigen::Matrix3d mount_ = Eigen::Matrix3d::Identity();
};

}  // namespace suspension_health_monitor
