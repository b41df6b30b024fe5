#pragma once

#include <functional>
#include <optional>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"
#include "suspension_health_monitor/internal/simulation/sensors.h"
#include "suspension_health_monitor/internal/simulation/vehicle_motion.h"

namespace suspension_health_monitor {

/// One instant of a simulated drive.
struct DriveSample {
  Stamp stamp{};                                 ///< true time since the start of the drive
  std::optional<AccelerometerReading> sprung;    ///< none: message lost, or the sensor reads at another instant
  std::optional<AccelerometerReading> unsprung;  ///< likewise
  std::optional<AccelerometerReading> road;      ///< where the tyre touches it, with the wheel's; none: message lost
  Sway body;                                     ///< what the body's IMU reads besides, noise included
  DriveTruth truth;
};

/// Drives a quarter car, equations (1)-(2) or with a rigid wheel (27), over a road and measures its two accelerations,
/// and that of the road under the wheel.
///
/// The body and a wheel on a tyre start at rest relative to the road, travel 0 (VehicleMotion).
/// Same options, same samples.
class DriveSimulator {
 public:
  /// @throws std::invalid_argument  as validate(SimulationOptions).
  explicit DriveSimulator(const SimulationOptions& options);

  /// @return the next instant at which a sensor reads, both at k / rate, k = 0 .. duration * rate, unless the options
  /// set them apart; none after the end of the drive.
  /// @throws std::invalid_argument  naming the hidden effects, if the strut runs away or is too stiff to be integrated.
  std::optional<DriveSample> next();

 private:
  /// The sensor reads at phase + k / rate, later by a uniform 0..sampling_jitter, and not after the end of the drive.
  struct ScheduledSensor {
    Accelerometer accelerometer;
    RandomStream timing;
    double rate, phase;   // [Hz], [s]
    double index = -1.0;  // k
    double next = 0.0;    // time of the next reading [s]; infinite after the end of the drive
  };

  void scheduleNext(ScheduledSensor& sensor) const;
  double readBody(double t, const Sway& sway);
  Sway withNoise(Sway sway);

  SimulationOptions options_;
  ScheduledSensor sprung_, unsprung_;
  Accelerometer road_;
  std::function<Sway(double t)> sway_;
  RandomStream sway_random_;
  SimulatedFaults faults_;
  VehicleMotion now_, delayed_;  // delayed: as the body's IMU sees it, faults_.delay ago
};

}  // namespace suspension_health_monitor
