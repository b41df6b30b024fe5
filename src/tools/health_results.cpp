#include <cmath>
#include <cstdio>

#include "json_of.h"
#include "results.h"
#include "suspension_health_monitor/internal/blocks/block_bins.h"
#include "suspension_health_monitor/internal/monitor/drive_identification.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

bool isDelayed(const StrutEstimate& estimate) {
  constexpr double kBeyondDoubt = 3.0;  // standard deviations
  return std::abs(estimate.delay) > kBeyondDoubt * estimate.delay_stddev && estimate.explained > kNearlyAll;
}

void printBlocks(const StrutEstimate& estimate, const std::optional<double>& mass) {
  printResult("estimate", toIdentified(estimate), mass);
  if (estimate.friction)
    std::printf("    dry friction %.3g +- %.1g m/s^2\n", estimate.friction->force, estimate.friction->stddev);
  if (isDelayed(estimate))
    std::printf("    the wheel carrier's readings are stamped %.3g +- %.1g ms late\n", 1e3 * estimate.delay,
                1e3 * estimate.delay_stddev);
  if (!std::isnan(estimate.age))
    std::printf("    explains %.1f %% of the body's motion, from %.3g s of data, on average %.3g s old\n",
                100.0 * estimate.explained, estimate.window, estimate.age);
}

void printRows(const char* name, const StrutEstimate& estimate, const std::optional<double>& mass) {
  printResult(name, toIdentified(estimate), mass);
  if (!std::isnan(estimate.offset))
    std::printf("    offset of the wheel carrier's IMU against the body's %.3g m/s^2\n", estimate.offset);
}

}  // namespace

void printHealth(const HealthLog& log, const SuspensionMonitor& monitor, const std::string& reference) {
  std::printf("judged by %s\n\n", reference.c_str());
  std::printf("%15s  %10s  %-5s  %s\n", "time [s]", "after [s]", "level", "reason");
  for (const HealthMoment& event : log.events())
    std::printf("%15.2f  %10.2f  %-5s  %s\n", toSeconds(event.time), toSeconds(event.elapsed), nameOf(event.level),
                event.message.c_str());
  std::printf("\nlevel    time [s]   share   events\n");
  const double covered = toSeconds(log.elapsed());
  for (const HealthLevel level : kHealthLevels) {
    const double seconds = toSeconds(log.duration(level));
    std::printf("%-5s  %10.2f  %4.0f %%  %7zu\n", nameOf(level), seconds,
                covered > 0.0 ? 100.0 * seconds / covered : 0.0, log.count(level));
  }
  std::printf("early warnings %zu", log.earlyWarnings().size());
  if (!log.earlyWarnings().empty()) std::printf(", the first at %.2f s", toSeconds(log.earlyWarnings().front().time));
  const HealthMoment end = log.latest();
  std::printf("\n\nat the end %s: %s\n", nameOf(end.level), end.message.c_str());
  printBlocks(monitor.report().estimate, monitor.options().sprung_mass);
  printRows("LS", monitor.report().ls, monitor.options().sprung_mass);
  printRows("LA", monitor.report().la, monitor.options().sprung_mass);
}

json toJson(const HealthLog& log, const SuspensionMonitor& monitor) {
  json result{{"events", jsonOf(log.events())},
              {"end", jsonOf(log.latest())},
              {"warn_events", log.count(HealthLevel::kWarn)},
              {"error_events", log.count(HealthLevel::kError)},
              {"early_warnings", log.earlyWarnings().size()}};
  for (const HealthLevel level : kHealthLevels) result["seconds"][nameOf(level)] = toSeconds(log.duration(level));
  const auto add = [&](const char* name, const StrutEstimate& estimate) {
    result[name] = toJson(toIdentified(estimate));
    result[name].update(jsonOf(estimate));
  };
  add("estimate", monitor.report().estimate);
  add("ls", monitor.report().ls);
  add("la", monitor.report().la);
  return result;
}

}  // namespace suspension_health_monitor
