#pragma once

#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

/// A free run beside the measurement over one segment of a drive: what every plot over time is made of.
/// All vectors have one entry per sample.
struct ComparedSegment {
  std::size_t record = 0;  ///< which of the drives, from 0
  double start = 0.0;      ///< time of the first sample since the start of that drive [s]
  double period = 0.0;     ///< T [s]
  std::vector<double> measured;     ///< z'' less the drive's mean w'' [m/s^2]
  std::vector<double> predicted;    ///< by the free run [m/s^2]
  std::vector<double> wheel;        ///< w'' less its mean [m/s^2]
  std::vector<double> travel;       ///< d of the free run, from its position at rest [m], compression positive
  std::vector<double> travel_rate;  ///< v of the free run [m/s]

  std::size_t size() const { return measured.size(); }

  /// @return since the start of the drive [s].
  double time(std::size_t sample) const { return start + static_cast<double>(sample) * period; }

  /// @return measured - predicted [m/s^2]: positive where the body is pushed up harder than the model says.
  double residual(std::size_t sample) const { return measured[sample] - predicted[sample]; }
};

}  // namespace suspension_health_monitor
