#pragma once

#include <ros/time.h>

#include <boost/noncopyable.hpp>
#include <string>

#include "live_model.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/wording/health_log.h"
#include "task_log.h"

namespace suspension_health_monitor {

/// Tells the terminal at the end of a drive how it was: the worst level, how long each lasted, and the last estimates.
/// A drive ends with this object, or once a simulated clock, that of a bag, has stood still for a while. The next
/// summary covers all messages since the start.
class DriveSummary : boost::noncopyable {
 public:
  /// @param strut  as the lines name it.
  /// @param timeout  [s]: reports further apart say nothing of the time between them, which is stale; and so long, by
  /// the wall, a clock stands still first.
  DriveSummary(const std::string& strut, double timeout);
  ~DriveSummary();

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

/// What /diagnostics says of a strut's health as its monitor sees it, however old that is.
void describeHealth(const SuspensionMonitor& monitor, Status& status);

/// What /diagnostics says of its model.
void describeModel(const LiveModel& model, const SuspensionMonitor& monitor, Status& status);

}  // namespace suspension_health_monitor
