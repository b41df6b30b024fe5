#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

struct ComparedDrives {
  std::vector<ComparedSegment> segments;
  std::vector<std::vector<StrutState>> motion;  ///< of the free runs, per segment and sample
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
/// @return nothing if the model runs away.  @pre model.stiffness_to_mass > 0.
std::optional<ComparedDrives> compareSegments(const Records& records, const StrutModel& model,
                                              const std::vector<StrutState>& initial);

}  // namespace suspension_health_monitor
