#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/drive.h"

namespace suspension_health_monitor {

inline constexpr int kMostStruts = 16;      ///< of a vehicle
inline constexpr int kMostKnownForces = 4;  ///< that act on its body and are measured

/// @throws std::invalid_argument  unless a vehicle can have so many.
void requireNumStruts(std::size_t count);
void requireNumKnownForces(std::size_t count);

/// One number per strut; on the stack, as samples come.
using StrutVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostStruts, 1>;

/// One number per strut and strut.
using StrutMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostStruts, kMostStruts>;

/// One number per known force.
using ForceVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostKnownForces, 1>;

/// One number per strut and known force.
using ForceMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostStruts, kMostKnownForces>;

/// What all accelerometers of a vehicle read at one instant: CornerSample of every strut.
struct VehicleSample {
  Stamp stamp{};
  StrutVector sprung;    ///< z_i'' [m/s^2] of the body at the top of strut i
  StrutVector unsprung;  ///< w_i'' [m/s^2] of its wheel carrier
  ForceVector forces;    ///< known forces, in any unit
  /// w_i'' before the low-pass filter that everything else here has passed [m/s^2]; empty: nothing has been filtered.
  StrutVector unfiltered{};
  double road = std::nan("");  ///< acceleration of the road [m/s^2]; NaN: not measured near this instant

  /// @return what the two accelerometers of strut i read.
  CornerSample ofStrut(std::size_t i) const {
    const auto row = static_cast<Eigen::Index>(i);
    return {stamp, sprung[row], unsprung[row]};
  }
};

}  // namespace suspension_health_monitor
