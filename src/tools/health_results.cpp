#include "health_results.h"

#include <array>
#include <cinttypes>
#include <cmath>
#include <utility>

#include "identify_tables.h"
#include "suspension_health_monitor/internal/monitor/drive_identification.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

constexpr std::array kLevels{HealthLevel::kOk, HealthLevel::kWarn, HealthLevel::kError, HealthLevel::kStale};

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char character : text) result += character == '"' ? std::string(2, character) : std::string(1, character);
  return result + '"';
}

void printEstimate(const char* name, const StrutEstimate& estimate, const std::optional<double>& mass) {
  printResult(name, atTheEnd(estimate), mass);
  if (!std::isnan(estimate.offset))
    std::printf("    offset of the wheel carrier's IMU against the body's %.3g m/s^2, stamped %.3g ms late\n",
                estimate.offset, 1e3 * estimate.clock_skew);
}

void printFriction(const std::optional<DryFriction>& friction) {
  if (friction)
    std::printf("    dry friction beside them %.3g m/s^2, standard deviation %.1g\n", friction->force,
                friction->stddev);
}

}  // namespace

HealthTable::HealthTable(std::FILE* out, std::vector<std::string> struts) : out_(out), struts_(std::move(struts)) {
  if (out_ == nullptr) return;
  std::fprintf(out_, "time,%slevel,message,b1,b0,b1_stddev,b0_stddev,offset\n", struts_.empty() ? "" : "strut,");
}

void HealthTable::add(std::size_t strut, const HealthMoment& moment) {
  if (out_ == nullptr) return;
  constexpr std::int64_t second = 1000000000;
  const StrutEstimate& la = moment.la;
  std::fprintf(out_, "%" PRId64 ".%09" PRId64 ",", moment.stamp.count() / second, moment.stamp.count() % second);
  if (!struts_.empty()) std::fprintf(out_, "%s,", struts_[strut].c_str());
  std::fprintf(out_, "%s,%s,%.17g,%.17g,%.17g,%.17g,%.17g\n", nameOf(moment.level), quoted(moment.message).c_str(),
               la.damping_to_mass, la.stiffness_to_mass, la.damping_to_mass_stddev, la.stiffness_to_mass_stddev,
               la.offset);
}

void printHealth(const HealthLog& log, const SuspensionMonitor& monitor, const std::string& reference) {
  std::printf("judged by %s\n\n", reference.c_str());
  std::printf("%15s  %10s  %-5s  %s\n", "time [s]", "after [s]", "level", "reason");
  for (const HealthMoment& event : log.events())
    std::printf("%15.2f  %10.2f  %-5s  %s\n", toSeconds(event.stamp), toSeconds(event.elapsed), nameOf(event.level),
                event.message.c_str());
  std::printf("\nlevel    time [s]   share   events\n");
  const double covered = toSeconds(log.elapsed());
  for (const HealthLevel level : kLevels) {
    const double seconds = toSeconds(log.duration(level));
    std::printf("%-5s  %10.2f  %4.0f %%  %7zu\n", nameOf(level), seconds,
                covered > 0.0 ? 100.0 * seconds / covered : 0.0, log.count(level));
  }
  std::printf("early warnings %zu", log.earlyWarnings().size());
  if (!log.earlyWarnings().empty()) std::printf(", the first at %.2f s", toSeconds(log.earlyWarnings().front().stamp));
  const HealthMoment end = log.latest();
  std::printf("\n\nat the end %s: %s\n", nameOf(end.level), end.message.c_str());
  printEstimate("LS", monitor.report().ls, monitor.options().sprung_mass);
  printEstimate("LA", monitor.report().la, monitor.options().sprung_mass);
  printFriction(monitor.report().ls.friction);
}

json toJson(const HealthMoment& moment) {
  return {{"time", toSeconds(moment.stamp)}, {"level", nameOf(moment.level)}, {"message", moment.message}};
}

json secondsJson(const HealthLog& log) {
  json seconds;
  for (const HealthLevel level : kLevels) seconds[nameOf(level)] = toSeconds(log.duration(level));
  return seconds;
}

json estimatesJson(const SuspensionMonitor& monitor) {
  json estimates;
  const auto add = [&](const char* name, const StrutEstimate& estimate) {
    estimates[name] = toJson(atTheEnd(estimate));
    estimates[name]["offset"] = estimate.offset;
    estimates[name]["clock_skew"] = estimate.clock_skew;
    if (estimate.friction)
      estimates[name]["friction"] = {{"force", estimate.friction->force},
                                     {"stddev", estimate.friction->stddev},
                                     {"damping_gain", estimate.friction->damping_gain},
                                     {"stiffness_gain", estimate.friction->stiffness_gain}};
    estimates[name]["damping_excitation"] = estimate.damping_excitation;
    estimates[name]["stiffness_excitation"] = estimate.stiffness_excitation;
  };
  add("la", monitor.report().la);
  add("ls", monitor.report().ls);
  return estimates;
}

json toJson(const HealthLog& log, const SuspensionMonitor& monitor) {
  json result = estimatesJson(monitor);
  json events = json::array();
  for (const HealthMoment& event : log.events()) events.push_back(toJson(event));
  result["seconds"] = secondsJson(log);
  result["events"] = events;
  result["end"] = toJson(log.latest());
  result["warn_events"] = log.count(HealthLevel::kWarn);
  result["error_events"] = log.count(HealthLevel::kError);
  result["early_warnings"] = log.earlyWarnings().size();
  return result;
}

}  // namespace suspension_health_monitor
