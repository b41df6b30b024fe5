#pragma once

#include <optional>

#include "suspension_health_monitor/internal/simulation/random_stream.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"

namespace suspension_health_monitor {

/// When one sensor of a simulated drive reads: at phase + k / rate, later by a uniform 0..jitter.
class SensorSchedule {
 public:
  /// The first reading is at t = 0, or at the phase; none is after the duration.
  /// @param rate  [Hz].  @param phase  [s].  @param timing  for the jitter; no number is drawn without any.
  SensorSchedule(double rate, double phase, const SimulationOptions& options, RandomPurpose timing);

  /// @return time of the next reading [s]; none after the end of the drive.
  std::optional<double> next() const { return next_; }

  /// Goes on to the reading after.
  void advance();

 private:
  double rate_, phase_, jitter_, duration_;
  RandomStream random_;
  long long index_ = -1;
  std::optional<double> next_;
};

}  // namespace suspension_health_monitor
