#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

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
  CornerSample ofStrut(std::size_t i) const { return {stamp, sprung[i], unsprung[i]}; }
};

/// Which streams of a StreamGrid are what on a vehicle. All of them but the road must be required ones.
struct VehicleChannels {
  struct Strut {
    std::size_t unsprung = 0;           ///< stream of w''
    std::optional<std::size_t> sprung;  ///< stream of z''; none: the body's IMU tells it
    /// Of the strut's top, from the body's IMU, or from any point of the body where every strut has its own [m].
    std::optional<Eigen::Vector3d> position;
  };
  std::vector<Strut> struts;
  /// Stream of the body's IMU that reads its acceleration along x; those along y and z, and the angular rates about x,
  /// y, z, are the next five.
  std::optional<std::size_t> body_imu;
  /// Turns what the body's IMU reads into axes whose z is up, those of the positions: column i is that of its axis i.
  Eigen::Matrix3d body_mount = Eigen::Matrix3d::Identity();
  std::vector<std::size_t> known_forces;  ///< streams
  std::optional<std::size_t> road;        ///< stream, that is not required: of the road under the one strut

  /// @return those of struts that have two accelerometers each.
  static VehicleChannels ofAccelerometers(std::size_t struts = 1, std::size_t known_forces = 0) {
    VehicleChannels result;
    std::size_t stream = 0;
    for (std::size_t i = 0; i < struts; ++i, stream += 2) result.struts.push_back({stream, stream + 1, {}});
    while (known_forces-- > 0) result.known_forces.push_back(stream++);
    return result;
  }
  /// @return x, y by strut; empty unless every strut has a position.
  std::vector<std::array<double, 2>> places() const {
    std::vector<std::array<double, 2>> result;
    for (const Strut& strut : struts)
      if (strut.position) result.push_back({strut.position->x(), strut.position->y()});
    if (result.size() < struts.size()) result.clear();
    return result;
  }
  /// @return how many struts' tops the body's IMU tells.
  std::size_t numTopsOfBody() const {
    return static_cast<std::size_t>(
        std::count_if(struts.begin(), struts.end(), [](const Strut& strut) { return !strut.sprung; }));
  }
};

/// What one sensor of a vehicle read at one time.
struct VehicleReading {
  enum class Sensor { kUnsprung, kSprung, kBody, kForce, kRoad };

  Sensor sensor;
  std::size_t place;  ///< of the strut, or of the known force; of the body's IMU 0
  Stamp stamp;
  /// Acceleration along the strut [m/s^2]; a known force; of the body's IMU the acceleration along x, y, z [m/s^2],
  /// then the angular rate about them [rad/s].
  std::array<double, 6> values;
};

/// What an accelerometer of a strut alone read [m/s^2].
inline VehicleReading readingOf(Side side, Stamp stamp, double acceleration) {
  using Sensor = VehicleReading::Sensor;
  return {side == Side::kUnsprung ? Sensor::kUnsprung : Sensor::kSprung, 0, stamp, {acceleration}};
}

/// Calls take(reading) for every reading of an instant, of struts that have two accelerometers each.
template <class Take>
void forReadings(const VehicleSample& sample, const Take& take) {
  const auto give = [&](VehicleReading::Sensor sensor, Eigen::Index place, double value) {
    take(VehicleReading{sensor, static_cast<std::size_t>(place), sample.stamp, {value}});
  };
  for (Eigen::Index i = 0; i < sample.sprung.size(); ++i) {
    give(VehicleReading::Sensor::kSprung, i, sample.sprung[i]);
    give(VehicleReading::Sensor::kUnsprung, i, sample.unsprung[i]);
  }
  for (Eigen::Index k = 0; k < sample.forces.size(); ++k) give(VehicleReading::Sensor::kForce, k, sample.forces[k]);
}

}  // namespace suspension_health_monitor
