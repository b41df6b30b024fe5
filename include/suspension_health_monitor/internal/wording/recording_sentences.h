#pragma once

#include <string>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/signal/uniform_grid.h"

namespace suspension_health_monitor {

/// What came of a recording, in words for people: of bags and of arrays.

/// @return what was kept out, reason by reason: "; rejected clipped: 12"; empty if nothing was.
std::string describeRejected(const RejectCounts& rejected);

/// @return why the readings have not given one regression row; empty if they have.
std::string describeNoRow(const SuspensionMonitor& monitor, const UniformGrid& grid, const RejectCounts& rejected);

/// @param file  that the baseline was read from; empty: none was.
/// @return what the strut was judged by at the end.
std::string describeReference(const Baseline& baseline, const std::string& file);

}  // namespace suspension_health_monitor
