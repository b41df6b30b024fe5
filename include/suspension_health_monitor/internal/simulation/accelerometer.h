#pragma once

#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"

namespace suspension_health_monitor {

/// One message of one accelerometer, without gravity.
struct AccelerometerReading {
  Stamp stamp{};              ///< by the sensor's own clock
  double acceleration = 0.0;  ///< [m/s^2], up positive
};

/// A simulated accelerometer: adds noise, loses messages, stamps by its own clock.
class Accelerometer {
 public:
  /// The clocks of wheel and road show true time; clock_offset and clock_skew are the sprung sensor's.
  enum class Place { kSprung, kUnsprung, kRoad };

  Accelerometer(const SimulationOptions& options, Place place);

  /// @param t  true time of the measurement since the start of the drive [s].
  /// @param acceleration  what an ideal sensor would read [m/s^2].
  /// @return the message, or none when it is lost. Noise and stamp error are drawn in either case, so that the n-th
  ///   reading has the same ones with and without dropouts.
  std::optional<AccelerometerReading> read(double t, double acceleration);

 private:
  double drawNoise();

  RandomStream noise_random_;
  RandomStream delivery_random_;
  double noise_;
  bool gaussian_;
  double dropout_;
  double stamp_jitter_;
  double clock_offset_;
  double clock_rate_;
};

}  // namespace suspension_health_monitor
