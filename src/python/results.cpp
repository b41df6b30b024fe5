#include "results.h"

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {

Identification Identification::of(const IdentifyResult& found, const VehiclePipeline& made, std::size_t strut,
                                  const Course& course) {
  const SuspensionMonitor& monitor = *made.strut(strut);
  Identification result;
  static_cast<IdentifyResult&>(result) = found;
  result.mean_period = monitor.input().mean_period;
  result.alignment = describeAlignment(made.grid()->streams());
  result.bridged = made.grid()->streams().bridged();
  if (made.tyre() != nullptr) result.tyre = made.tyre()->report();
  result.sprung_mass = monitor.options().sprung_mass;
  result.course = course;
  return result;
}

HealthSummary HealthSummary::of(const HealthLog& log, const SuspensionMonitor& monitor,
                                const std::optional<std::string>& file, const RejectCounts& rejected,
                                const Course& course) {
  HealthSummary summary;
  static_cast<ModelReport&>(summary) = monitor.report();
  summary.events = log.events();
  summary.early_warnings = log.earlyWarnings();
  summary.end = log.latest();
  summary.end.time -= course.shift();
  for (std::vector<HealthMoment>* moments : {&summary.events, &summary.early_warnings})
    for (HealthMoment& moment : *moments) moment.time -= course.shift();
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
