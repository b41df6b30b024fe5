#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <ros/time.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "live_model.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/wording/health_log.h"
#include "task_log.h"

namespace suspension_health_monitor {

/// Tells the terminal at the end of a drive how it was: the worst level, how long each lasted, and the last estimates.
/// A drive ends with this object, or once a simulated clock, that of a bag, has stood still for a while. The next
/// summary covers all messages since the start.
class DriveSummary {
 public:
  /// @param strut  as the lines name it.
  /// @param timeout  [s]: reports further apart say nothing of the time between them, which is stale; and so long, by
  /// the wall, a clock stands still first.
  DriveSummary(const std::string& strut, double timeout);
  ~DriveSummary();
  DriveSummary(const DriveSummary&) = delete;
  DriveSummary& operator=(const DriveSummary&) = delete;

  /// Takes in a report of any sample. No allocation.
  void add(const MonitorReport& report);

  /// To be called now and then: has the clock stopped?
  void watchClock();

 private:
  /// @param until  what ended the drive; empty: this object ends.  @param say  prints a line.
  void tell(const char* until, void (*say)(const std::string& line));

  std::string strut_;
  double timeout_;  // [s]
  MonitorReport newest_;
  bool is_news_ = false;  // something has come since it was reported
  LevelTimes times_;
  ros::Time clock_;
  ros::WallTime stands_since_;
};

/// What /diagnostics says of one strut, as its monitor sees it: a task each for its health and its model.
class StrutDiagnostics {
 public:
  /// @return the strut's monitor; nullptr: there is none yet.
  using Find = std::function<const SuspensionMonitor*()>;

  /// @return topics that the strut needs and that are silent while others go on.
  using FindSilent = std::function<std::vector<std::string>()>;

  /// @param name  of the strut, for the terminal.
  /// @param input_timeout  [s] as the option.  @param model  outlives this object.
  StrutDiagnostics(const std::string& name, double input_timeout, const LiveModel& model, FindSilent silent)
      : input_timeout_(input_timeout),
        silent_(std::move(silent)),
        model_(model),
        log_(name),
        drive_(name, input_timeout) {}

  /// Adds the tasks to an updater that does not outlive this object.
  /// @param why_none  says why there is no monitor.
  void addTo(diagnostic_updater::Updater& updater, const Find& find, const std::function<std::string()>& why_none);

  /// @return true if the level differs from the last one: a change is published at once.
  bool note(const MonitorReport& report);

 private:
  /// When a reading was accepted last, as seen from the reports.
  struct Accepted {
    std::uint64_t samples = 0;
    ros::Time at;
  };

  void describeHealth(const SuspensionMonitor& monitor, Status& status);
  void describeSilence(const SuspensionMonitor& monitor, Status& status);
  void describeModel(const SuspensionMonitor& monitor, Status& status);
  void describeDiagnosis(Status& status) const;

  double input_timeout_;
  FindSilent silent_;
  std::optional<Accepted> accepted_;
  const LiveModel& model_;
  TaskLog log_;  // of Health
  DriveSummary drive_;
  std::optional<HealthLevel> level_;
};

/// What a strut has no monitor for, at first.
inline constexpr const char* kMeasuringPeriod = "measuring the sample period";

}  // namespace suspension_health_monitor
