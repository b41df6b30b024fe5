#include "identify_verdict.h"

#include "suspension_health_monitor/internal/monitor/drive_identification.h"

namespace suspension_health_monitor {

namespace {

// Parked at the end: what was learned on the drive still holds.
bool isHeld(EstimateDoubt doubt) {
  return doubt == EstimateDoubt::kNotExcited || doubt == EstimateDoubt::kDampingNotExcited ||
         doubt == EstimateDoubt::kStiffnessNotExcited;
}

}  // namespace

std::optional<std::string> whyNotValid(const SuspensionMonitor& monitor, bool was_valid) {
  if (monitor.report().ls.valid() || monitor.report().la.valid()) return std::nullopt;
  if (auto warning = periodWarning(monitor)) return warning;
  if (was_valid && isHeld(monitor.report().la.doubt)) return std::nullopt;
  if (!was_valid) return "no estimate was ever valid: too short, too little motion, or not the two sides of one strut";
  return "no estimate is valid at the end of the drive: " + std::string(describe(monitor.report().la.doubt)) +
         " (column \"valid\")";
}

}  // namespace suspension_health_monitor
