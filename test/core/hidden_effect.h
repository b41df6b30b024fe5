#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {

/// An effect for SimulationOptions::hidden whose force has `share` of the linear force's rms in the drive without it.
/// @param shapes  in SI.  Effects without memory only.
inline ActiveEffect hiddenEffect(SimulationOptions options, const std::string& name, std::vector<double> shapes,
                                 double share) {
  options.noise = 0.0;
  ActiveEffect active{findEffect(forceEffects(), name), 0.0, std::move(shapes)};
  double linear = 0.0, force = 0.0;
  for (const DriveSample& sample : drive(options)) {
    const DriveTruth& truth = sample.truth;
    linear += std::pow(truth.sprung_acceleration, 2);
    const StrutMotion motion{truth.travel, truth.travel_rate, toSeconds(sample.stamp), 0.0};
    force += std::pow(active.effect.force(motion, active.shapes.data()), 2);
  }
  active.coefficient = share * std::sqrt(linear / force);
  return active;
}

/// The reference car on its road, 100 Hz, with healthy damping.
inline SimulationOptions carDrive(double duration, double noise, int seed = 1) {
  SimulationOptions options = scenario("iso_road", duration);
  options.vehicle = "golden_car";
  options.rate = 100.0;
  options.noise = noise;
  options.gaussian_noise = true;
  options.seed = seed;
  return options;
}

}  // namespace suspension_health_monitor
