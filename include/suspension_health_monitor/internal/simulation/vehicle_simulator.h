#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/simulation/road.h"
#include "suspension_health_monitor/internal/simulation/sensors.h"
#include "suspension_health_monitor/internal/simulation/vehicle.h"
#include "suspension_health_monitor/internal/simulation/vehicle_motion.h"

namespace suspension_health_monitor {

/// What a simulated drive of a vehicle is like.
struct VehicleDriveOptions {
  std::string tracks = "coherent";
  double duration = 120.0;
  int seed = 1;
  double rate = 100.0, noise = 0.03, gyro_noise = 0.002, stamp_jitter = 0.0, dropout = 0.0, gravity = 9.81;
};

inline constexpr OptionField<VehicleDriveOptions> kVehicleDriveFields[] = {
    {"drive", "tracks", "-",
     "left and right on an ISO 8608 road; coherent: lines of one isotropic surface; the rear follows "
     "the front, wheelbase / speed later",
     &VehicleDriveOptions::tracks, 0, 0, "coherent identical independent"},
    {"drive", "duration", "s", "length of the drive; samples at both ends", &VehicleDriveOptions::duration, 0.0, 1e6},
    {"drive", "seed", "-", "same options and seed, same drive", &VehicleDriveOptions::seed, 0, 2147483647},
    {"sensors", "rate", "Hz", "samples per second of all sensors", &VehicleDriveOptions::rate, 0.1, 20000.0},
    {"sensors", "noise", "m/s^2", "standard deviation of every accelerometer's white noise",
     &VehicleDriveOptions::noise, 0.0, 1e3},
    {"sensors", "gyro_noise", "rad/s", "likewise of the gyro", &VehicleDriveOptions::gyro_noise, 0.0, 1e3},
    {"sensors", "stamp_jitter", "s", "stamps are late by a uniform 0..stamp_jitter, less than 1 / rate",
     &VehicleDriveOptions::stamp_jitter, 0.0, 10.0},
    {"sensors", "dropout", "-", "share of messages lost, each sensor by itself", &VehicleDriveOptions::dropout, 0.0,
     1.0},
    {"sensors", "gravity", "m/s^2", "what an upright IMU reads on z at rest (REP 145)", &VehicleDriveOptions::gravity,
     -100.0, 100.0},
};

/// @throws std::invalid_argument  naming option, value and what is allowed.
void validate(const VehicleDriveOptions& options);

/// The road under every wheel. Front wheels are the foremost; what is behind follows on the same line, later by
/// distance / speed. Coherent: the line at the wheel's own y of one isotropic surface (IsoRoad). Identical: one line.
/// Independent: the left (y > 0), the right and the middle of three surfaces.
std::vector<Road> tracksOf(const Vehicle& vehicle, const std::string& tracks, int seed);

/// One message of the body's IMU, in its own axes, gravity included.
struct SixAxisReading {
  Stamp stamp{};
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< [m/s^2]
  Eigen::Vector3d angular_rate = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// What an ideal IMU on the body reads: (z'' + g) of a vertical that tilts with the body, + alpha x r + w x (w x r),
/// turned into its axes. No offsets.
SixAxisReading readIdeally(const VehicleTruth& truth, const VehicleImu& imu, double gravity);

/// One instant of a simulated drive of a vehicle. A message that was lost is missing.
struct VehicleInstant {
  struct Strut {
    std::optional<AccelerometerReading> sprung, unsprung;  ///< vertical, without gravity
  };

  Stamp stamp{};              ///< true time since the start of the drive
  std::vector<Strut> struts;  ///< by Vehicle::struts
  std::optional<SixAxisReading> body;
  std::vector<double> known_forces;  ///< as measured, by Vehicle::known_forces, up positive [N]
  VehicleTruth truth;
};

/// Drives a vehicle over a road and measures it. Same options, same samples.
class VehicleSimulator {
 public:
  /// @throws std::invalid_argument  as validate() of either.
  VehicleSimulator(const Vehicle& vehicle, const VehicleDriveOptions& options);

  /// @return the next instant, k / rate, k = 0 .. duration * rate; none after the end of the drive.
  /// @throws std::invalid_argument  as VehicleMotion::advance().
  std::optional<VehicleInstant> next();

 private:
  std::optional<SixAxisReading> readBody(double t);

  Vehicle vehicle_;
  VehicleDriveOptions options_;
  VehicleMotion motion_;
  double index_ = 0.0;  // of the next instant
  std::vector<Accelerometer> sprung_, unsprung_;
  Accelerometer body_;
  RandomStream body_noise_, gyro_noise_, force_noise_;
};

/// Changes a vehicle by settings, and takes them out of `values`: those of kVehicleFields by their names;
/// struts/NAME/FIELD, with effects as struts/NAME/effects/EFFECT/coefficient and /SHAPE; body_imu/FIELD;
/// anti_roll_bars/NAME/OTHER, a stiffness; known_forces/NAME/FIELD, of a new force or of one that is there.
/// @throws std::invalid_argument  naming the setting, and what is allowed.
void changeVehicle(OptionMap& values, const EffectLibrary& library, Vehicle& vehicle);

/// Makes a vehicle of such settings; its struts are those that they name.
/// @throws std::invalid_argument  also naming a setting that is missing.
Vehicle takeVehicle(OptionMap& values, const EffectLibrary& library);

}  // namespace suspension_health_monitor
