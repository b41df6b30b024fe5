#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/identify.h"
#include "suspension_health_monitor/internal/compare/travel_statistics.h"
#include "suspension_health_monitor/internal/math/digest.h"
#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"
#include "suspension_health_monitor/internal/wording/health_log.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {

/// What Python gets of arrays and of bags alike, where it is more than what the library's public calls return.

/// What was known over time, thinned out evenly where a drive is long: for plots.
class Course {
 public:
  /// @param shift  that was added to all stamps.
  explicit Course(Stamp shift = {}) : shift_(shift) {}

  /// Takes in a report; one without a regression row says nothing.
  void add(MonitorReport report) {
    report.stamp -= shift_;
    if (report.has_row) points_.add(report);
  }

  Stamp shift() const { return shift_; }
  const std::vector<MonitorReport>& points() const { return points_.items(); }

 private:
  static constexpr std::size_t kWanted = 2000;  // more than a plot has pixels

  Stamp shift_;
  Digest<MonitorReport> points_{kWanted};
};

struct Identification : IdentifyResult {
  double mean_period = 0.0;  ///< of uninterrupted samples [s]
  std::string alignment;     ///< how readings became samples, in words
  std::uint64_t bridged = 0;
  std::optional<TyreReport> tyre;
  std::optional<double> sprung_mass;  ///< [kg], as it was given
  std::string change;                 ///< how the strut is against the healthy one, in a sentence; empty: none is known
  Course course;

  /// @param made  what a strut, by its place, was identified by.
  static Identification of(const IdentifyResult& found, const VehiclePipeline& made, std::size_t strut,
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
};

struct SearchedStrut : Diagnosis {
  std::string change;  ///< likewise
  StrutCurves curves{};
  TravelStatistics travel{};
};

/// With the estimates at the end.
struct HealthSummary : ModelReport {
  std::vector<HealthMoment> events, early_warnings;
  HealthMoment end;
  std::map<std::string, double> seconds;      ///< by level [s]
  std::map<std::string, std::size_t> counts;  ///< changes to it
  std::string reference;                      ///< what the strut was judged by at the end, in words
  Baseline baseline;                          ///< the same
  std::map<std::string, std::uint64_t> rejected;
  Course course;

  /// @param file  that the baseline was read from, which was given; empty: of none; nothing: it was not given.
  static HealthSummary of(const HealthLog& log, const SuspensionMonitor& monitor,
                          const std::optional<std::string>& file, const RejectCounts& rejected, const Course& course) {
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
};

}  // namespace suspension_health_monitor
