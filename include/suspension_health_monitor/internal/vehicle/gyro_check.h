#pragma once

#include <array>
#include <cstddef>

#include "suspension_health_monitor/internal/math/running_means.h"

namespace suspension_health_monitor {

/// Whether the gyro of a body's IMU has died while the vehicle drove: an axis turns a tenth as much as on average, or
/// less, while the body moves up and down as before. By chance the power of a block, of a dozen independent numbers or
/// more, is not a hundred times smaller than on average. VehicleClaims finds a gyro that never turned.
class GyroCheck {
 public:
  /// @param powers  of a_z, w_x, w_y in the band of a block.
  void add(const std::array<double, 3>& powers) {
    const auto isLow = [&](std::size_t axis) { return powers[axis] < square(kSmall) * power_.mean(axis); };
    if (power_.weight() >= kFewestForScatter && powers[0] > kSmall * power_.mean(0)) is_dead_ = isLow(1) || isLow(2);
    if (!is_dead_) power_.add(powers);
  }

  /// @return true if it was so in the newest block in which the body moved.
  bool isDead() const { return is_dead_; }

 private:
  RunningMeans<3> power_{0.99};  // of the last hundred blocks
  bool is_dead_ = false;
};

}  // namespace suspension_health_monitor
