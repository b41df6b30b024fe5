#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/discrepancy/drive_record.h"

namespace suspension_health_monitor {

/// A free run beside the measurement over one segment of a drive: what every plot over time is made of.
/// All vectors have one entry per sample.
struct ComparedSegment {
  std::size_t record = 0;             ///< which of the drives, from 0
  double start = 0.0;                 ///< time of the first sample since the start of that drive [s]
  double period = 0.0;                ///< T [s]
  std::vector<double> measured;       ///< z'' less the drive's mean w'' [m/s^2]
  std::vector<double> predicted;      ///< by the free run [m/s^2]
  std::vector<double> wheel;          ///< w'' less its mean [m/s^2]
  std::vector<double> travel;         ///< d of the free run, from its mean position [m], compression positive
  std::vector<double> travel_rate;    ///< v of the free run [m/s]
  std::vector<double> added_force;    ///< sum c_j f_j, the effects' part of the model [m/s^2]
  std::vector<double> missing_force;  ///< what the model lacks, per unit mass [m/s^2]; see compareSegments()

  std::size_t size() const { return measured.size(); }

  /// @return since the start of the drive [s].
  double time(std::size_t sample) const { return start + static_cast<double>(sample) * period; }

  /// @return measured - predicted [m/s^2]: positive where the body is pushed up harder than the free run says.
  double residual(std::size_t sample) const { return measured[sample] - predicted[sample]; }
};

/// Runs the model freely over all segments of all drives.
///
/// The residual r of a free run is not yet the force that is missing: the run's travel is wrong by -(r integrated
/// twice), and the model's force with it. A missing force f leaves r = f s^2 / (s^2 + b1 s + b0), in quadrature with f
/// at the strut's natural frequency and with the wrong sign below. So
///   missing force = y - model(d - J J r, v - J r),
/// J an integral that forgets what is slower than a third of the natural frequency w0 (or drift would win): each is
/// multiplied by w^4 / (w^4 + (w0/3)^4), without a change of phase. A constant in r is left out.
/// @param initial  per segment of all records.
/// @return nothing if the model runs away.
std::optional<std::vector<ComparedSegment>> compareSegments(const std::vector<const DriveRecord*>& records,
                                                            const StrutModel& model,
                                                            const std::vector<StrutState>& initial);

}  // namespace suspension_health_monitor
