#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/signal/stream_grid.h"

namespace suspension_health_monitor {

/// What came of a recording, in words for people: of bags and of arrays.

/// @return by how much a stretch of a drive differs from the rest, and what to do.
std::string describe(const ChangedStretch& stretch);

/// @return what was kept out, reason by reason: "; rejected clipped: 12"; empty if nothing was.
std::string describeRejected(const RejectCounts& rejected);

/// @return what in the readings may be why they show no strut: "; ..." for each suspicion, empty without any.
/// @param grid  of a strut alone, whose streams are numbered by Side; nullptr: it is not.
std::string describeSuspicions(const MonitorReport& report, const StreamGrid* grid);

/// @return why instants are missing though nothing gets lost: readings of a required stream come every 3/2 T or more.
/// Empty if they come often enough.
std::string describeSlowReadings(const StreamGrid& grid);

/// @return "paired", "resampled", or "resampled because ...".
std::string describeAlignment(const StreamGrid& grid);

/// @param where  there are too few readings: "on one of the topics".
/// @return why `count` readings tell no sample period.
std::string describeNoPeriod(const std::string& where, std::size_t count);

/// @param where  likewise.
/// @return why a live monitor has not begun.
std::string describeNoStart(const std::string& where);

/// @return why the readings have not given one regression row; empty if they have.
std::string describeNoRow(const SuspensionMonitor& monitor, const StreamGrid& grid, const RejectCounts& rejected);

/// @param spacing  of the stamps [s]; nothing: they tell none.
/// @return why a sample period is so far below the spacing that nearly all samples would be made up; empty if it is
/// not.
std::string describeShortPeriod(double sample_period, const std::optional<double>& spacing);

/// @param file  that the baseline was read from; empty: none was.
/// @return what the strut was judged by at the end.
std::string describeReference(const Baseline& baseline, const std::string& file);

}  // namespace suspension_health_monitor
