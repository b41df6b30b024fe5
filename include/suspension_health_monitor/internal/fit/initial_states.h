#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Estimates travel and travel rate at the start of every segment, the model's numbers being given: least squares of
/// the free run against z'' while the start is remembered (ten time constants of the slower free motion).
/// Gauss-Newton with the two sensitivities by differences: exact after one step for a linear strut.
/// @param model  b1, b0 > 0.
/// @return one state per segment of all records; nothing if the model runs away.
std::optional<std::vector<StrutState>> estimateInitialStates(const Records& records, const StrutModel& model);

}  // namespace suspension_health_monitor
