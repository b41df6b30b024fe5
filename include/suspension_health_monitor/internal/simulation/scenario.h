#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/simulation/road.h"
#include "suspension_health_monitor/internal/simulation/vehicle.h"

namespace suspension_health_monitor {

/// As many hidden effects a strut can have.
inline constexpr std::size_t kMostHiddenEffects = 4;

/// What a simulated drive is like. The meaning of what users may set is in kSimulationFields.
struct SimulationOptions {
  std::string scenario = "paper_clean", vehicle = "default";
  std::optional<double> damping_to_mass, stiffness_to_mass, damping_end_fraction;
  double ramp_start = 40.0;  ///< when the damping begins to change [s]
  double ramp_end = 100.0;   ///< when it has changed, after ramp_start [s]

  std::string iso_class = "default";
  std::optional<double> speed;
  double duration = 120.0;
  int seed = 1;

  double rate = 50.0;
  std::optional<double> unsprung_rate;
  double unsprung_phase = 0.0, sampling_jitter = 0.0, noise = 0.024;
  bool gaussian_noise = false;  ///< true: normal; false: uniform within +-sqrt(3) noise, as in the paper
  double dropout = 0.0, stamp_jitter = 0.0, clock_offset = 0.0, clock_skew = 0.0;

  double body_acceleration = 0.0, body_rate = 0.0;
  double gyro_noise = 0.001;  ///< standard deviation of the white noise on both rates [rad/s]

  std::vector<ActiveEffect> hidden = {};  ///< effects that the model lacks, at most kMostHiddenEffects
  std::vector<ActiveMeasurementEffect> hidden_faults = {};  ///< what is wrong with the body's IMU (sensors.h)
};

inline constexpr OptionField<SimulationOptions> kSimulationFields[] = {
    {"drive", "scenario", "-",
     "paper_clean: the paper's road (31); paper_outliers: and both readings 0 at 25..26 s and 65..66 s; "
     "paper_saturation: and bumps (32) at 85 s and 110 s into end stops at +-0.09 m; iso_road: an ISO 8608 road",
     &SimulationOptions::scenario, 0, 0, "paper_clean paper_outliers paper_saturation iso_road"},
    {"drive", "vehicle", "-", "masses, strut and tyre; default: paper in the paper's scenarios, golden_car on iso_road",
     &SimulationOptions::vehicle, 0, 0, "default paper golden_car rover ugv"},
    {"drive", "damping_to_mass", "1/s", "b1 at the start; none: the vehicle's", &SimulationOptions::damping_to_mass,
     0.0, 1e5},
    {"drive", "stiffness_to_mass", "1/s^2", "b0; none: the vehicle's", &SimulationOptions::stiffness_to_mass, 1e-3,
     1e8},
    {"drive", "damping_end_fraction", "-",
     "share of the damping that is left when it has worn, from 40 s to 100 s; 1: a healthy drive; none: "
     "2/3 in the paper's scenarios, 1 on iso_road",
     &SimulationOptions::damping_end_fraction, 0.0, 10.0},
    {"drive", "iso_class", "-", "road class of iso_road, A smooth; default: the vehicle's",
     &SimulationOptions::iso_class, 0, 0, "default A B C D E F G H"},
    {"drive", "speed", "m/s", "speed on iso_road; none: the vehicle's", &SimulationOptions::speed, 0.01, 200.0},
    {"drive", "duration", "s", "length of the drive; samples at both ends", &SimulationOptions::duration, 0.0, 1e6},
    {"drive", "seed", "-", "same options and seed, same drive", &SimulationOptions::seed, 0, 2147483647},
    {"sensors", "rate", "Hz", "samples per second of both sensors; a car on iso_road shakes up to 2.83 speed Hz",
     &SimulationOptions::rate, 0.1, 20000.0},
    {"sensors", "unsprung_rate", "Hz", "samples per second of the unsprung sensor; none: rate",
     &SimulationOptions::unsprung_rate, 0.1, 20000.0},
    {"sensors", "unsprung_phase", "s", "when the unsprung sensor reads first", &SimulationOptions::unsprung_phase, 0.0,
     10.0},
    {"sensors", "sampling_jitter", "s",
     "readings are taken, and stamped, late by a uniform 0..sampling_jitter, less than one period of "
     "the faster sensor",
     &SimulationOptions::sampling_jitter, 0.0, 10.0},
    {"sensors", "stamp_jitter", "s",
     "stamps are late by a uniform 0..stamp_jitter, less than one sample period; the readings are not",
     &SimulationOptions::stamp_jitter, 0.0, 10.0},
    {"sensors", "clock_offset", "s", "what the sprung sensor's clock shows at the start of the drive",
     &SimulationOptions::clock_offset, -10.0, 10.0},
    {"sensors", "clock_skew", "s/s", "how much faster than true time the sprung sensor's clock runs",
     &SimulationOptions::clock_skew, -0.01, 0.01},
    {"sensors", "dropout", "-", "share of messages lost, each sensor by itself", &SimulationOptions::dropout, 0.0, 1.0},
    {"sensors", "noise", "m/s^2", "standard deviation of either sensor's white noise", &SimulationOptions::noise, 0.0,
     1e3},
    {"sensors", "body_acceleration", "m/s^2", "rms of braking and cornering, on x and y of the body's IMU; 0: none",
     &SimulationOptions::body_acceleration, 0.0, 1e3},
    {"sensors", "body_rate", "rad/s", "rms of roll and pitch rate, on x and y of the body's IMU; 0: it has no gyro",
     &SimulationOptions::body_rate, 0.0, 1e3},
};

/// Checks ranges (kSimulationFields), the order of the ramp's ends, that jitter keeps the stamps in order, the number
/// of hidden effects, and that hidden faults are known and have a motion to act on.
/// @throws std::invalid_argument  naming option, value and what is allowed.
void validate(const SimulationOptions& options);

/// @return readings per second of the faster sensor.
double fasterRate(const SimulationOptions& options);

/// One wheel, its strut and the share of the body above it, paper section 2.1, as a vehicle that only heaves:
///
///   M z'' = beta (w' - z') + K (w - z)                          (1)
///   m w'' = -beta (w' - z') - K (w - z) - K0 (w - mu)           (2)
///
/// z sprung, w unsprung position, mu road height [m], up positive, all counted from the static equilibrium, so gravity
/// does not appear. On a rigid wheel (K0 -> infinity) w = mu, and m drops out.
/// @param options  valid.  @return the vehicle of the drive, with its ramp, end stops and hidden effects.
Vehicle quarterCarOf(const SimulationOptions& options);

/// @param options  valid.  @return the road of the drive.
Road roadOf(const SimulationOptions& options);

/// @param t  since the start of the drive [s].  @return true while all readings are 0, as the scenario wants it.
bool losesReadings(const SimulationOptions& options, double t);

}  // namespace suspension_health_monitor
