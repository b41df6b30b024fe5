#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"

namespace suspension_health_monitor {

/// Estimates over time, a line per report; "-" for what is not known.
void printTable(const std::vector<MonitorReport>& reports);

/// @param name  of the estimator.  @param mass  of the body [kg], for damping and stiffness in SI.
void printResult(const char* name, const IdentifiedStrut& estimate, const std::optional<double>& mass);

/// @param strut  by the same estimator.
void printTyre(const char* name, const WheelEstimate& estimate, const StrutEstimate& strut);

}  // namespace suspension_health_monitor
