#pragma once

#include <array>
#include <vector>

#include "suspension_health_monitor/internal/simulation/body_sway.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// What is wrong with the body's IMU.
struct SensorFaults {
  double delay = 0.0;                ///< it reads what was so long ago [s]
  double bias = 0.0;                 ///< [m/s^2]
  double gain_error = 0.0;           ///< [-]
  std::array<double, 2> tilt{};      ///< share of x and y that its z axis sees [rad]
  std::array<double, 2> position{};  ///< x, y from the top of the strut to the sensor [m]

  /// @param hidden  faults by the catalogue's names; names and sizes are all that is taken from there.
  /// @throws std::invalid_argument  naming one that the simulator does not know, and those that it does.
  static SensorFaults from(const std::vector<ActiveMeasurementEffect>& hidden);

  /// @param acceleration  z'' of the strut's top [m/s^2], `delay` ago.
  /// @return what an otherwise ideal sensor reads on its z axis, without gravity [m/s^2].
  double read(double acceleration, const Sway& sway) const;
};

}  // namespace suspension_health_monitor
