#pragma once

#include <array>
#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/simulation/body_sway.h"
#include "suspension_health_monitor/internal/simulation/integration_guard.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"
#include "suspension_health_monitor/internal/simulation/sensors.h"

namespace suspension_health_monitor {

/// What the simulator knows and no sensor tells, at one instant.
struct DriveTruth {
  double damping_to_mass = 0.0;        ///< b1 [1/s]
  double stiffness_to_mass = 0.0;      ///< b0 [1/s^2]
  double travel = 0.0;                 ///< d = w - z [m], compression positive
  double travel_rate = 0.0;            ///< v = w' - z' [m/s]
  double road_height = 0.0;            ///< mu [m]
  double sprung_acceleration = 0.0;    ///< z'' without noise [m/s^2]
  double unsprung_acceleration = 0.0;  ///< w'' without noise [m/s^2]
  double road_acceleration = 0.0;      ///< mu'' without noise [m/s^2]
};

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
/// The body and a wheel on a tyre start at rest relative to the road, travel 0.
/// Integration: Dormand-Prince 5(4) with error control, 1e-10 absolute (m, m/s) and 1e-10 relative per step; steps end
/// on the samples and are at most 1/10 of the fastest time constant, stops included, so that none jumps over a contact.
/// Same options, same samples. Its formulas are its own: estimation shares no code with it but the sign conventions.
class DriveSimulator {
 public:
  /// @throws std::invalid_argument  as validate(SimulationOptions).
  explicit DriveSimulator(const SimulationOptions& options);

  /// @return the next instant at which a sensor reads, both at k / rate, k = 0 .. duration * rate, unless the options
  /// set them apart; none after the end of the drive.
  /// @throws std::invalid_argument  naming the hidden effects, if the strut runs away or is too stiff to be integrated.
  std::optional<DriveSample> next();

 private:
  // z, z' and, of a wheel on a tyre, w, w'; then the memories of hidden effects. Places that are not needed stay 0.
  using State = std::array<double, 4 + 2 * kMostHiddenEffects>;

  struct Motion {
    DriveTruth truth;
    State derivative;
  };

  /// The vehicle at one time, from where it is integrated on.
  struct Course {
    State state{};
    double time = 0.0;  // [s]
  };

  struct ScheduledSensor {
    Accelerometer accelerometer;
    SensorSchedule schedule;
  };

  Motion motionAt(const State& state, double t);
  Motion motionAt(const Course& course) { return motionAt(course.state, course.time); }
  void integrate(Course& course, double to);
  double readBody(const Sway& sway);

  Scenario scenario_;
  ScheduledSensor sprung_, unsprung_;
  Accelerometer road_;
  BodySway sway_;
  SwaySensor sway_sensor_;
  SensorFaults faults_;
  Course now_, delayed_;  // delayed: as the body's IMU sees it, faults_.delay ago
  double max_step_;       // [s]
  IntegrationGuard guard_;
};

}  // namespace suspension_health_monitor
