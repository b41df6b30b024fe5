#pragma once

#include <array>
#include <vector>

#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {

struct SimulationOptions;

/// How the body moves otherwise than up and down, at one instant; x ahead, y to the left (REP 103).
struct Sway {
  std::array<double, 2> acceleration{};          ///< along x (braking), y (cornering) [m/s^2]
  std::array<double, 2> angular_rate{};          ///< about x (roll), y (pitch) [rad/s]
  std::array<double, 2> angular_acceleration{};  ///< [rad/s^2]
};

/// The random motion of a body that brakes, corners, pitches and rolls: on each axis a sum of sines of random frequency
/// and phase, 0.1 to 1 Hz for the accelerations, which so cancel over a drive, 0.3 to 4 Hz for the angular rates.
/// Nothing else about it is physical; it does not act back on the strut.
class BodySway {
 public:
  explicit BodySway(const SimulationOptions& options);

  Sway at(double t) const;

 private:
  struct Sine {
    double amplitude, frequency, phase;  // frequency [rad/s]
  };
  using Sines = std::vector<Sine>;

  std::array<Sines, 2> accelerations_, rates_;
};

}  // namespace suspension_health_monitor
