#pragma once

#include <cmath>
#include <cstddef>

namespace suspension_health_monitor {

/// The numbers that decide of a vehicle.
struct VehicleTuning {
  // Gravity in the readings: BodyLevel, MountClaim.
  double part = 2.0;               ///< of a mean, whose scatter is measured [s]
  int fewest_parts = 5;            ///< of one level, ten seconds: longer than most braking, pulling away and bends
  std::size_t most_windows = 3;    ///< of so many parts: those manoeuvres take less than half of them
  double most_parts = 60.0;        ///< two minutes
  double other_axis = M_PI / 4.0;  ///< lean from which another axis of the IMU is nearer to upright [rad]
  /// of a road of 9 %, steeper ones are rare, of the load or of a careful hand [rad]. An IMU that leans by less reads
  /// so little of the gravity that pitch and roll turn that b0 is wrong by 2 %.
  double largest_lean = 5.0 / 180.0 * M_PI;

  // The noise of the sensors.
  double noise_memory = 4096.0;       ///< samples: the ratio of two deviations within 2 %
  std::size_t fewest_of_noise = 256;  ///< samples: the same within 5 %
  /// of a gyro over that of an accelerometer until both have been heard [s/m]: 0.002 rad/s, 0.03 m/s^2
  double gyro_noise_ratio = 0.002 / 0.03;
  std::size_t noise_drive = 1 << 14;  ///< samples: their rms has an error of 0.6 %
  double noise_reach = 0.1;  ///< of the filter of shared noise, to either side [s]; twice as far takes 2 % more
  /// Errors of the models, which are in the residuals, too, in the unit of the noise: twice that of an accelerometer.
  /// With less, sums of residuals that have next to no noise carry over into each strut what the ratios are off by.
  double model_variance = 4.0;

  // The motion of one strut without the others: Decoupler.
  int means = 3;                 ///< of a mean of a mean, which leave the slow travel
  double offset_memory = 40.0;   ///< of the mean relative acceleration [s]
  double mean_memory = 10.0;     ///< of the mean force and the mean reading [s]
  double washout = 1.0 / 200.0;  ///< of the natural frequency: what is slower is forgotten
  double washout_damping = 0.7;  ///< damping ratio of the washout: no resonance
  /// over the age of a series: what its start made is forgotten as fast as anything can be known
  double washout_start = 2.0;
  double longest_period = 4.0;  ///< natural period [s]: softer is no suspension

  // The fit of the rigid body: fitRigidBody(), VehicleBlocks.
  double least_phi = 1e-4;        ///< of what is searched: no sensor resolves less
  double most_phi = 1.0;          ///< likewise: rows that no rigid body explains at all
  int halvings = 14;              ///< of the logarithm of phi: to 0.06 %
  double longest_gyration = 1.5;  ///< radius of gyration over half the wheelbase, or track: no vehicle has more
  double smallest_spread = 1e-6;  ///< of places and inertias, below which there is none
  double least_upper_edge = 2.5;  ///< of the band, in bounces
  double most_periods = 6.0;      ///< of the bounce in a block; 1.6 of a car's
  double start_damping = 0.6;     ///< b1 over the bounce: a damping ratio of 0.3

  // What the vehicle file claims: VehicleClaims.
  double noise_known_to = 0.1;  ///< of its mean: with it 300 numbers, of all bins, rows and columns
  double fits = 0.2;            ///< share of the motion of the tops that a file which is right leaves at most
  int refinements = 3;          ///< of the size of a mistake
  double farthest = 100.0;      ///< of the struts of any vehicle from its IMU [m]
  double nearest = 0.01;        ///< two struts nearer than that are one [m]
  double models_every = 0.1;    ///< the Decoupler takes new models of the struts [s]
};

inline constexpr VehicleTuning kVehicleTuning;

}  // namespace suspension_health_monitor
