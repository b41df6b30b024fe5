#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/model/quarter_car.h"
#include "suspension_health_monitor/option_table.h"
#include "suspension_health_monitor/simulation/road.h"
#include "suspension_health_monitor/simulation/strut.h"

namespace suspension_health_monitor {

/// What a simulated drive is like. The meaning of every field is in kSimulationFields.
struct SimulationOptions {
  std::string scenario = "paper_clean";
  std::string vehicle = "default";
  std::optional<double> damping_to_mass;
  std::optional<double> stiffness_to_mass;

  bool damping_ramp = true;
  std::optional<double> damping_end_fraction;
  double ramp_start = 40.0;
  double ramp_end = 100.0;

  std::string iso_class = "default";
  std::optional<double> speed;
  double duration = 120.0;
  double rate = 50.0;
  std::optional<double> sprung_rate;
  std::optional<double> unsprung_rate;
  double unsprung_phase = 0.0;
  double sampling_jitter = 0.0;
  int seed = 1;

  double noise = 0.024;
  std::string noise_distribution = "uniform";
  double dropout = 0.0;
  double stamp_jitter = 0.0;
  double clock_offset = 0.0;
  double clock_skew = 0.0;

  double body_acceleration = 0.0;
  double body_rate = 0.0;
  double gyro_noise = 0.001;

  std::vector<ActiveEffect> hidden = {};  ///< effects that the model lacks, at most kMostHiddenEffects
  std::vector<ActiveMeasurementEffect> hidden_faults = {};  ///< what is wrong with the body's IMU (sensor_faults.h)
};

inline constexpr std::array kSimulationFields{
    OptionField<SimulationOptions>{
        "scenario", "-",
        "paper_clean: the paper's road (31); paper_outliers: and both readings 0 at 25..26 s and 65..66 s; "
        "paper_saturation: and bumps (32) at 85 s and 110 s into end stops at +-0.09 m; iso_road: an ISO 8608 road",
        &SimulationOptions::scenario, 0, 0, "paper_clean paper_outliers paper_saturation iso_road"},
    OptionField<SimulationOptions>{"vehicle", "-",
                                   "masses, strut and tyre; default: paper in the paper's scenarios, golden_car on "
                                   "iso_road",
                                   &SimulationOptions::vehicle, 0, 0, "default paper golden_car rover ugv"},
    OptionField<SimulationOptions>{"damping_to_mass", "1/s", "b1 at the start; none: the vehicle's",
                                   &SimulationOptions::damping_to_mass, 0.0, 1e5},
    OptionField<SimulationOptions>{"stiffness_to_mass", "1/s^2", "b0; none: the vehicle's",
                                   &SimulationOptions::stiffness_to_mass, 1e-3, 1e8},
    OptionField<SimulationOptions>{"damping_ramp", "-", "false: a healthy drive, the damping stays as it is",
                                   &SimulationOptions::damping_ramp},
    OptionField<SimulationOptions>{"damping_end_fraction", "-",
                                   "share of the damping left when the ramp ends; none: 2/3 in the paper's scenarios, "
                                   "1 on iso_road",
                                   &SimulationOptions::damping_end_fraction, 0.0, 10.0},
    OptionField<SimulationOptions>{"ramp_start", "s", "when the damping begins to change",
                                   &SimulationOptions::ramp_start, 0.0, 1e6},
    OptionField<SimulationOptions>{"ramp_end", "s", "when the damping has changed, after ramp_start",
                                   &SimulationOptions::ramp_end, 0.0, 1e6},
    OptionField<SimulationOptions>{"iso_class", "-", "road class of iso_road, A smooth; default: the vehicle's",
                                   &SimulationOptions::iso_class, 0, 0, "default A B C D E F G H"},
    OptionField<SimulationOptions>{"speed", "m/s", "speed on iso_road; none: the vehicle's", &SimulationOptions::speed,
                                   0.01, 200.0},
    OptionField<SimulationOptions>{"duration", "s", "length of the drive; samples at both ends",
                                   &SimulationOptions::duration, 0.0, 1e6},
    OptionField<SimulationOptions>{"rate", "Hz",
                                   "samples per second of both sensors; a car on iso_road shakes up to 2.83 speed Hz",
                                   &SimulationOptions::rate, 0.1, 20000.0},
    OptionField<SimulationOptions>{"sprung_rate", "Hz", "samples per second of the sprung sensor; none: rate",
                                   &SimulationOptions::sprung_rate, 0.1, 20000.0},
    OptionField<SimulationOptions>{"unsprung_rate", "Hz", "samples per second of the unsprung sensor; none: rate",
                                   &SimulationOptions::unsprung_rate, 0.1, 20000.0},
    OptionField<SimulationOptions>{"unsprung_phase", "s", "when the unsprung sensor reads first",
                                   &SimulationOptions::unsprung_phase, 0.0, 10.0},
    OptionField<SimulationOptions>{"sampling_jitter", "s",
                                   "readings are taken, and stamped, late by a uniform 0..sampling_jitter, less than "
                                   "one period of the faster sensor",
                                   &SimulationOptions::sampling_jitter, 0.0, 10.0},
    OptionField<SimulationOptions>{"seed", "-", "same options and seed, same drive", &SimulationOptions::seed, 0,
                                   2147483647},
    OptionField<SimulationOptions>{"noise", "m/s^2", "standard deviation of either sensor's white noise",
                                   &SimulationOptions::noise, 0.0, 1e3},
    OptionField<SimulationOptions>{"noise_distribution", "-", "uniform: within +-sqrt(3) noise; gaussian: normal",
                                   &SimulationOptions::noise_distribution, 0, 0, "uniform gaussian"},
    OptionField<SimulationOptions>{"dropout", "-", "share of messages lost, each sensor by itself",
                                   &SimulationOptions::dropout, 0.0, 1.0},
    OptionField<SimulationOptions>{"stamp_jitter", "s",
                                   "stamps are late by a uniform 0..stamp_jitter, less than one sample period; the "
                                   "readings are not",
                                   &SimulationOptions::stamp_jitter, 0.0, 10.0},
    OptionField<SimulationOptions>{"clock_offset", "s",
                                   "what the sprung sensor's clock shows at the start of the drive",
                                   &SimulationOptions::clock_offset, -10.0, 10.0},
    OptionField<SimulationOptions>{"clock_skew", "s/s", "how much faster than true time the sprung sensor's clock runs",
                                   &SimulationOptions::clock_skew, -0.01, 0.01},
    OptionField<SimulationOptions>{"body_acceleration", "m/s^2",
                                   "rms of braking and cornering, on x and y of the body's IMU; 0: none",
                                   &SimulationOptions::body_acceleration, 0.0, 1e3},
    OptionField<SimulationOptions>{"body_rate", "rad/s",
                                   "rms of roll and pitch rate, on x and y of the body's IMU; 0: it has no gyro",
                                   &SimulationOptions::body_rate, 0.0, 1e3},
    OptionField<SimulationOptions>{"gyro_noise", "rad/s", "standard deviation of the white noise on both rates",
                                   &SimulationOptions::gyro_noise, 0.0, 1e3},
};

/// Checks ranges (kSimulationFields), the order of the ramp's ends, that jitter keeps the stamps in order, the number
/// of hidden effects, and that hidden faults are known and have a motion to act on.
/// @throws std::invalid_argument  naming option, value and what is allowed.
void validate(const SimulationOptions& options);

/// @return readings per second of the faster sensor.
double fasterRate(const SimulationOptions& options);

/// A stretch of time [first, last] in [s], both ends included.
struct TimeWindow {
  double first, last;

  bool contains(double t) const { return t >= first && t <= last; }
};

/// What the options amount to: the vehicle and its strut, the road, the faults of the sensors' wiring.
struct Scenario {
  QuarterCar vehicle;  ///< at the start of the drive
  Strut strut;
  Road road;
  std::vector<TimeWindow> zero_readings;  ///< both accelerations read 0
};

/// @throws std::invalid_argument  as validate().
Scenario makeScenario(const SimulationOptions& options);

}  // namespace suspension_health_monitor
