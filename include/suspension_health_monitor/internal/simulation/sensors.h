#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// How the body moves otherwise than up and down, at one instant; x ahead, y to the left (REP 103).
struct Sway {
  std::array<double, 2> acceleration{};          ///< along x (braking), y (cornering) [m/s^2]
  std::array<double, 2> angular_rate{};          ///< about x (roll), y (pitch) [rad/s]
  std::array<double, 2> angular_acceleration{};  ///< [rad/s^2]
};

/// @return the random motion of a body that brakes, corners, pitches and rolls, by time [s]: on each axis a sum of
/// sines of random frequency and phase, 0.1 to 1 Hz for the accelerations, which so cancel over a drive, 0.3 to 4 Hz
/// for the angular rates. Nothing else about it is physical; it does not act back on the strut.
std::function<Sway(double t)> swayOf(const SimulationOptions& options);

/// @return when reading k is taken, phase + k / rate [s]; none after the end of the drive. A duration that is a whole
/// number of periods does not lose its last reading to rounding.
inline std::optional<double> instantOf(double k, double rate, double phase, double duration) {
  if (k > (duration - phase) * rate + 1e-6) return std::nullopt;
  return phase + k / rate;
}

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

  /// @param index  which one of several at such a place, each with noise of its own.
  Accelerometer(const SimulationOptions& options, Place place, unsigned index = 0);

  /// @param t  true time of the measurement since the start of the drive [s].
  /// @param acceleration  what an ideal sensor would read [m/s^2].
  /// @return the message, or none when it is lost. Noise and stamp error are drawn in either case, so that the n-th
  ///   reading has the same ones with and without dropouts.
  std::optional<AccelerometerReading> read(double t, double acceleration);

 private:
  RandomStream noise_random_, delivery_random_;
  double noise_;
  bool gaussian_;
  double dropout_, stamp_jitter_, clock_offset_, clock_rate_;
};

/// What is wrong with the body's IMU.
struct SimulatedFaults {
  double delay = 0.0;                ///< it reads what was so long ago [s]
  double bias = 0.0;                 ///< [m/s^2]
  double gain_error = 0.0;           ///< [-]
  std::array<double, 2> tilt{};      ///< share of x and y that its z axis sees [rad]
  std::array<double, 2> position{};  ///< x, y from the top of the strut to the sensor [m]

  /// @param hidden  faults by the catalogue's names; names and sizes are all that is taken from there.
  /// @throws std::invalid_argument  naming one that the simulator does not know, and those that it does.
  static SimulatedFaults from(const std::vector<ActiveMeasurementEffect>& hidden);

  /// @param acceleration  z'' of the strut's top [m/s^2], `delay` ago.
  /// @return what an otherwise ideal sensor reads on its z axis, without gravity [m/s^2].
  double read(double acceleration, const Sway& sway) const;

  /// @return what it reads of gravity, which comes on top of that [m/s^2].
  double readAtRest(double gravity) const;
};

}  // namespace suspension_health_monitor
