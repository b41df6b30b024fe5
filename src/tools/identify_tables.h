#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"

namespace suspension_health_monitor {

/// What a monitor made of the bags: period and horizon, samples, what was kept out, how readings were aligned.
void printInput(const SuspensionMonitor& monitor, const StreamGrid& grid, const BagOptions& options,
                const RejectCounts& rejected);

/// @throws TooLittleError  saying why, if the bags have not given one regression row.
void requireRows(const SuspensionMonitor& monitor, const StreamGrid& grid, const RejectCounts& rejected);

/// Estimates over time, a line per report; "-" for what is not known.
void printTable(const std::vector<MonitorReport>& reports);

/// @param name  of the estimator.  @param mass  of the body [kg], for damping and stiffness in SI.
void printResult(const char* name, const IdentifiedStrut& estimate, const std::optional<double>& mass);

/// Over the whole drive, which is what to trust; then LS and LA at its end.
void printEstimates(const IdentifyResult& found, const std::optional<double>& mass);

nlohmann::json toJson(const IdentifiedStrut& estimate);

/// Adds the same to a result for programs.
void addEstimates(const IdentifyResult& found, nlohmann::json& result);

/// How the strut is against the healthy one.
/// @param change  in a sentence; nothing is told of an empty one.
void printChange(const std::string& change);

/// @param strut  by the same estimator.
void printTyre(const char* name, const WheelEstimate& estimate, const StrutEstimate& strut);

/// @return why the strut is not known, neither over the whole drive nor at its end, in words; nothing: it is.
std::optional<std::string> whyNotValid(const IdentifyResult& found, const MonitorOptions& options);

}  // namespace suspension_health_monitor
