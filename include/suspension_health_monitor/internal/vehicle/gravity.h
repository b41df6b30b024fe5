#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {

/// How the IMU of a body is turned against upright, from the gravity in its readings.
struct BodyLevel {
  /// As it is given: nothing to turn.
  BodyLevel() = default;

  /// @param accelerations  of a while, in the IMU's axes [m/s^2]. The mean of a few medians is gravity, if it is as
  /// large as that: a vehicle brakes as much as it pulls away. An IMU that takes gravity off tells nothing.
  explicit BodyLevel(const std::vector<Eigen::Vector3d>& accelerations);

  /// @return true if the lean is more than that of a road, of the load or of a careful hand, which cannot be told from
  /// each other and do no harm.
  bool isTurned() const { return lean > kVehicleTuning.largest_lean; }

  double lean = 0.0;  ///< angle between the IMU's z axis and upright [rad]
  /// Of the accelerations, by the size of gravity in them; 1 unless it is off by more than an offset makes.
  double gain = 1.0;
  /// Gravity was the same in all parts of the while, but for half of what isTurned() allows: else the vehicle braked,
  /// pulled away or went round a bend.
  bool is_steady = true;
  /// What turns the IMU's axes upright, by the smallest angle; the identity unless isTurned().
  Eigen::Matrix3d mount = Eigen::Matrix3d::Identity();
};

/// Gravity as an IMU reads it: a vehicle neither climbs for good nor pulls away more than it brakes, so that the mean
/// of many readings is gravity. It is taken of parts of two seconds, whose scatter says how sure it is. Cost per
/// reading: O(1), no allocation.
class MountClaim {
 public:
  struct Finding {
    double size = 0.0;         ///< of gravity as it is read [m/s^2]
    double lean = 0.0;         ///< angle between gravity and the axis that the settings call upward [rad]
    double lean_stddev = 0.0;  ///< [rad]
    int axis = 0;              ///< of the IMU that is nearest to gravity: 0 x, 1 y, 2 z
    bool is_negative = false;  ///< that axis points down

    /// By more than a road, a load or a careful hand makes: from what rounds to kVehicleTuning.largest_lean on.
    bool isLeaning() const { return lean > kVehicleTuning.largest_lean - 0.5 / 180.0 * M_PI + kProven * lean_stddev; }
    bool isOnAnotherAxis() const { return lean > kVehicleTuning.other_axis; }
    std::string_view name() const;  ///< of the axis that points up: "x" to "-z"
    /// The two of a strut that is inclined.
    bool leansAs(const Finding& other) const {
      return std::abs(lean - other.lean) < kVehicleTuning.largest_lean && lean < kVehicleTuning.other_axis;
    }
    bool isWrongSize() const { return std::abs(size - kStandardGravity) > kLargestOffset; }
  };

  /// @param acceleration  in the IMU's axes [m/s^2].
  /// @return true if a part ends with it: what find() tells may be another than before.
  bool add(Stamp stamp, const Eigen::Vector3d& acceleration);

  /// @return false as long as too little was read to tell anything.
  bool isKnown() const { return parts_ >= kVehicleTuning.fewest_parts; }

  /// @param up  in the IMU's axes, of length 1.
  /// @return nothing as long as too little was read, or if the readings are without gravity.
  std::optional<Finding> find(const Eigen::Vector3d& up) const;

 private:
  std::optional<Stamp> begin_;  // of the part
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero(), mean_ = Eigen::Vector3d::Zero();
  double count_ = 0.0, parts_ = 0.0;
  double scatter_ = 0.0;  // sum of squares of parts' distances from the mean, over both axes across
};

}  // namespace suspension_health_monitor
