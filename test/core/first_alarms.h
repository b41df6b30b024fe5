#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// When health first said so; none: never.
struct FirstAlarms {
  std::optional<double> early, warn, error;  ///< [s]
};

inline FirstAlarms firstAlarms(const std::vector<CornerSample>& drive, const MonitorSettings& options) {
  FirstAlarms first;
  SuspensionMonitor monitor(options);
  for (const CornerSample& sample : drive) {
    const MonitorReport* report = monitor.addSample(sample);
    if (report == nullptr) continue;
    const double t = toSeconds(report->stamp);
    if (!first.early && report->health.early_warning) first.early = t;
    if (!first.warn && report->health.level == HealthLevel::kWarn) first.warn = t;
    if (!first.error && report->health.level == HealthLevel::kError) first.error = t;
  }
  return first;
}

}  // namespace suspension_health_monitor
