#include "results.h"

#include <stdexcept>

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {

Identification Identification::of(VehiclePipeline& made, const RejectCounts& rejected, const Course& course) {
  const SuspensionMonitor& monitor = *made.strut();
  const StreamGrid& streams = made.grid()->streams();
  const std::string nothing = describeNoRow(monitor, streams, rejected);
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
                                const Course& course) {
  HealthSummary summary;
  static_cast<ModelReport&>(summary) = monitor.report();
  summary.events = log.events();
  summary.early_warnings = log.earlyWarnings();
  summary.end = log.latest();
  summary.end.stamp -= course.shift();
  for (std::vector<HealthMoment>* moments : {&summary.events, &summary.early_warnings})
    for (HealthMoment& moment : *moments) moment.stamp -= course.shift();
  for (const HealthLevel level : kHealthLevels) {
    summary.seconds[nameOf(level)] = toSeconds(log.duration(level));
    summary.counts[nameOf(level)] = log.count(level);
  }
  summary.baseline = monitor.baseline();
  if (summary.baseline.learned && !file) {
    summary.baseline.from -= course.shift();
    summary.baseline.to -= course.shift();
  }
  summary.reference = describeReference(summary.baseline, file.value_or(""));
  summary.rejected = rejected.byName();
  summary.course = course;
  return summary;
}

}  // namespace suspension_health_monitor
