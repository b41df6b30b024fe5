#pragma once

#include <optional>
#include <string>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// @param was_valid  an estimate was valid at some time.
/// @return why neither LS nor LA is valid at the end of the drive, in words; nothing: one of them is, or both
///         are held, since the drive ends parked.
std::optional<std::string> whyNotValid(const SuspensionMonitor& monitor, bool was_valid);

}  // namespace suspension_health_monitor
