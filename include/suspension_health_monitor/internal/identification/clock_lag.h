#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// A rough strut, and by how much the body's clock is late where it shows.
struct LaggedStrut {
  StrutModel model;         ///< b1, b0 and clock_offset
  int horizon_samples = 0;  ///< that it was found with
};

/// Looks for an offset of the sensors' clocks, in steps of a sample or 5 ms up to 50 ms either way: the survey of
/// horizons (HorizonSurvey) with the body's readings moved by as much. Coarse: where a fit may begin.
/// @return the one that explains most; nothing if that is no offset, explains less than half, or less than the
/// sensors swapped do.
std::optional<LaggedStrut> lookForClockLag(const std::vector<Drive>& drives, double period);

}  // namespace suspension_health_monitor
