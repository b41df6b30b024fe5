#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/health/drive_change.h"
#include "suspension_health_monitor/monitor_options.h"

namespace suspension_health_monitor {

/// What the live monitor has found, in words for people; the rest of it is declared in monitor_report.h.

/// All levels, as lists of them go.
inline constexpr std::array kHealthLevels{HealthLevel::kOk, HealthLevel::kWarn, HealthLevel::kError,
                                          HealthLevel::kStale};

/// @return "OK", "WARN", "ERROR" or "STALE".
const char* nameOf(HealthLevel level);

/// @return e.g. "/front/imu is silent"; empty of none.
std::string describeSilent(const std::vector<std::string>& topics);

/// @param seconds  for which no reading was accepted.  @param silent  topics that nothing came on meanwhile, though
/// others went on.  @param before  what was said until then.
std::string describeNoReading(double seconds, const std::vector<std::string>& silent, const std::string& before);

/// @return one sentence, e.g. "rear_left damping 28 % below the other corners: damage".
std::string describe(const CornerComparisonReport& report);

/// What `identify` tells of a strut as a whole.
struct StrutOfDrive {
  StrutEstimate strut;
  std::string by;        ///< what it was estimated by, in words
  double horizon = 0.0;  ///< of the integral filter [s]
};

/// @return the strut over the whole drive, else, where that is not valid or not the strut at the end, as it is at the
/// end; nothing: neither is valid.
std::optional<StrutOfDrive> strutOf(const IdentifyResult& found);

/// @param options  whose payload_range counts.
/// @return how strutOf() is against the healthy one, in a sentence; empty where either is not known.
std::string describeChange(const IdentifyResult& found, const Baseline& healthy, const MonitorOptions& options);

/// @return the same of drives that were searched for effects.
std::string describeChange(const std::vector<Drive>& drives, const DiagnoseOptions& searched, const Baseline& healthy,
                           const MonitorOptions& options);

/// How a strut is against another drive: by how much, and where on the curves.
/// @param other  name of that drive.
/// @return e.g. "damping 23 % below march.bag (90 %: 20 to 26 %), softer in rebound above 0.3 m/s; stiffness within
/// -0.8 to +1.2 %", or "no certain change against march.bag: damping within -4 to +3 %; stiffness within
/// -0.8 to +1.2 %"; empty if neither b1 nor b0 can be compared.
std::string describe(const DriveChange& change, const std::string& other);

/// @param enough  to be known to, StrutEstimate::knownTo() [-].
/// @return why an estimate is not valid; where more motion is needed also what is known, and how much longer to drive.
std::string describeDoubt(const StrutEstimate& estimate, double enough);

}  // namespace suspension_health_monitor
