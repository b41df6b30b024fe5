#pragma once

#include <string>
#include <utility>
#include <vector>

#include "simulated_drive.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// A simulated drive with all that its body's IMU measures.
inline DriveRecord recordedWithBody(const SimulationOptions& options) {
  Drive record_drive;
  for (const DriveSample& sample : drive(options)) {
    if (sample.sprung)
      record_drive.body.push_back({sample.sprung->stamp, sample.body.acceleration, sample.body.angular_rate});
    if (sample.sprung && sample.unsprung)
      record_drive.samples.push_back(
          {sample.sprung->stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
  }
  return DriveRecord(record_drive, 1.0 / options.rate);
}

inline ActiveMeasurementEffect fault(const std::string& name, std::vector<double> coefficients) {
  return {findEffect(measurementEffects(), name), std::move(coefficients)};
}

/// A vehicle on its road with a body that brakes, corners, pitches and rolls.
inline SimulationOptions swayingDrive(const std::string& vehicle, int seed, double duration = 120.0) {
  SimulationOptions options;
  options.scenario = "iso_road";
  options.vehicle = vehicle;
  options.rate = 100.0;
  options.duration = duration;
  options.noise = 0.03;
  options.gaussian_noise = true;
  options.seed = seed;
  options.body_acceleration = 1.0;
  options.body_rate = 0.1;
  return options;
}

}  // namespace suspension_health_monitor
