#include "suspension_health_monitor/internal/simulation/sensor_faults.h"

#include <stdexcept>

namespace suspension_health_monitor {

SensorFaults SensorFaults::from(const std::vector<ActiveMeasurementEffect>& hidden) {
  SensorFaults faults;
  for (const ActiveMeasurementEffect& active : hidden) {
    const std::string& name = active.effect.name;
    const std::vector<double>& sizes = active.coefficients;
    if (name == "clock_offset")
      faults.delay = sizes.at(0);
    else if (name == "accelerometer_bias")
      faults.bias = sizes.at(0);
    else if (name == "scale_error")
      faults.gain_error = sizes.at(0);
    else if (name == "mount_tilt")
      faults.tilt = {sizes.at(0), sizes.at(1)};
    else if (name == "lever_arm")
      faults.position = {sizes.at(0), sizes.at(1)};
    else
      throw std::invalid_argument("hidden fault " + name + ", must be one of clock_offset, accelerometer_bias, " +
                                  "scale_error, mount_tilt, lever_arm");
  }
  return faults;
}

double SensorFaults::read(double acceleration, const Sway& sway) const {
  // Away from the strut's top a turning body moves up by (angular acceleration) x (position), z component.
  const double here =
      acceleration + sway.angular_acceleration[0] * position[1] - sway.angular_acceleration[1] * position[0];
  return (1.0 + gain_error) * (here + tilt[0] * sway.acceleration[0] + tilt[1] * sway.acceleration[1]) + bias;
}

}  // namespace suspension_health_monitor
