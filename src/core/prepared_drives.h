#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/record/motion_range.h"

namespace suspension_health_monitor {

/// What the facades start from.
struct PreparedDrives {
  Shortcoming shortcoming = Shortcoming::kNone;
  std::string reason;                             ///< to be read after "the drives"
  StrutModel start;                               ///< the model given, or a rough one by blocks
  std::deque<DriveRecord> records;                ///< one per drive; none if there is a shortcoming
  std::optional<StrutModel> lagged = {};          ///< a rough one with clock_offset, if the clocks seem to differ
  std::optional<MotionRange> one_frequency = {};  ///< if all motion is at one
};

/// Settings (DiagnoseOptions or CompareOptions) -> period, horizon, rough model, records with the body's motion; and
/// whether all of that is fit for free runs.
/// @param model  nothing: the linear strut.
/// @throws std::invalid_argument  for a period that is not above 0, a horizon below 1, or no drive.
PreparedDrives prepareDrives(const std::vector<Drive>& drives, const std::optional<double>& sample_period,
                             const std::optional<int>& horizon_samples, const std::optional<StrutModel>& model);

}  // namespace suspension_health_monitor
