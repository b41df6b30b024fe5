#include "results.h"

#include <stdexcept>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {
namespace {

HealthMoment shifted(HealthMoment moment, Stamp shift) {
  moment.stamp -= shift;
  return moment;
}

std::vector<HealthMoment> shifted(std::vector<HealthMoment> moments, Stamp shift) {
  for (HealthMoment& moment : moments) moment = shifted(moment, shift);
  return moments;
}

}  // namespace

Identification Identification::of(StrutPipeline& made, const RejectCounts& rejected, const Course& course) {
  const SuspensionMonitor& monitor = *made.monitor();
  const StreamGrid& streams = made.grid()->streams();
  const std::string nothing = describeNoRow(monitor, *made.grid(), rejected);
  if (!nothing.empty()) throw std::invalid_argument(nothing);
  Identification found;
  static_cast<IdentifyResult&>(found) = identified(monitor, made.overTheDrive(), made.rejected());
  found.rejected = rejected.byName();
  found.mean_period = monitor.input().mean_period;
  found.alignment = streams.describeAlignment();
  found.bridged = streams.bridged();
  if (made.tyre() != nullptr) found.tyre = made.tyre()->report();
  found.sprung_mass = monitor.options().sprung_mass;
  found.course = course;
  return found;
}

HealthSummary HealthSummary::of(const HealthLog& log, const SuspensionMonitor& monitor,
                                const std::optional<std::string>& file, const RejectCounts& rejected,
                                const Course& course, Stamp shift) {
  HealthSummary summary;
  summary.events = shifted(log.events(), shift);
  summary.early_warnings = shifted(log.earlyWarnings(), shift);
  summary.end = shifted(log.latest(), shift);
  for (const HealthLevel level : kHealthLevels) {
    summary.seconds[nameOf(level)] = toSeconds(log.duration(level));
    summary.counts[nameOf(level)] = log.count(level);
  }
  summary.estimate = monitor.report().estimate;
  summary.ls = monitor.report().ls;
  summary.la = monitor.report().la;
  summary.baseline = monitor.baseline();
  if (summary.baseline.learned && !file) {
    summary.baseline.from -= shift;
    summary.baseline.to -= shift;
  }
  summary.reference = describeReference(summary.baseline, file.value_or(""));
  summary.rejected = rejected.byName();
  summary.course = course;
  return summary;
}

}  // namespace suspension_health_monitor
