#pragma once

#include "suspension_health_monitor/internal/vehicle/strut_tops.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What a gyro's noise is over that of an accelerometer until both have been heard [s/m]: 0.002 rad/s, 0.03 m/s^2.
inline constexpr double kUsualGyroNoise = 0.002 / 0.03;

/// @return the noise of a vehicle each of whose struts has two accelerometers of its own, all alike.
SensorNoise noiseOfOwnSensors(std::size_t num_struts);

/// @return the noise as it is known; where it is empty that of own sensors.
SensorNoise knownNoise(const SensorNoise& noise, std::size_t num_struts);

/// @param gyro_noise  standard deviation of a gyro's noise over that of an accelerometer's [s/m].
/// @return the noise of a vehicle's sensors behind its StrutTops.
SensorNoise noiseOfStrutTops(const VehicleChannels& channels, Stamp period, double gyro_noise);

/// @return in how many struts a wrong reading of one sensor shows, of the sensor that shows in most.
std::ptrdiff_t mostStrutsOfASensor(const SensorNoise& noise);

/// @return a drive that is nothing but the noise of all sensors, long enough to tell its size within a percent.
StrutDrives makeNoiseDrive(const SensorNoise& noise, double period);

}  // namespace suspension_health_monitor
