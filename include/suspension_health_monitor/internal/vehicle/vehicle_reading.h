#pragma once

#include <array>
#include <cstddef>

#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"

namespace suspension_health_monitor {

/// What one sensor of a vehicle read at one time.
struct VehicleReading {
  enum class Sensor { kWheel, kTop, kBody, kForce };

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
  return {side == Side::kUnsprung ? Sensor::kWheel : Sensor::kTop, 0, stamp, {acceleration}};
}

/// Calls take(reading) for every reading of an instant, of struts that have two accelerometers each.
template <class Take>
void forReadings(const VehicleSample& sample, const Take& take) {
  const auto give = [&](VehicleReading::Sensor sensor, Eigen::Index place, double value) {
    take(VehicleReading{sensor, static_cast<std::size_t>(place), sample.stamp, {value}});
  };
  for (Eigen::Index i = 0; i < sample.sprung.size(); ++i) {
    give(VehicleReading::Sensor::kTop, i, sample.sprung[i]);
    give(VehicleReading::Sensor::kWheel, i, sample.unsprung[i]);
  }
  for (Eigen::Index k = 0; k < sample.forces.size(); ++k) give(VehicleReading::Sensor::kForce, k, sample.forces[k]);
}

}  // namespace suspension_health_monitor
