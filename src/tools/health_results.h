#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/monitor/health_log.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// One line per moment, full precision: `suspension_bag health --csv`.
class HealthTable {
 public:
  /// @param out  nullptr: no table is wanted.  @param struts  names of a vehicle's, for a column; empty: one strut.
  HealthTable(std::FILE* out, std::vector<std::string> struts);

  void add(std::size_t strut, const HealthMoment& moment);

 private:
  std::FILE* out_;
  std::vector<std::string> struts_;
};

/// The result for people: a line per change of level, then the times, and the estimates at the end.
void printHealth(const HealthLog& log, const SuspensionMonitor& monitor, const std::string& reference);

/// @return time, level and message by name.
nlohmann::json toJson(const HealthMoment& moment);

/// @return the seconds by level.
nlohmann::json secondsJson(const HealthLog& log);

/// @return the block estimate, LS and LA at the end, by name.
nlohmann::json estimatesJson(const SuspensionMonitor& monitor);

/// The result for programs.
nlohmann::json toJson(const HealthLog& log, const SuspensionMonitor& monitor);

}  // namespace suspension_health_monitor
