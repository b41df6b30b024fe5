#pragma once

#include <optional>
#include <string>

#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {

/// @return what is wrong with the stamps for the sample period that was given, in words; nothing: they fit.
std::optional<std::string> periodWarning(const SuspensionMonitor& monitor);

/// @param over_the_drive  the block estimate over all readings.  @param rejected  readings that were kept out.
/// @return what is known of a strut at the end of a recorded drive.
IdentifyResult identified(const SuspensionMonitor& monitor, const StrutEstimate& over_the_drive,
                          const RejectCounts& rejected);

}  // namespace suspension_health_monitor
