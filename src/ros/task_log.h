#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <optional>
#include <string>

namespace suspension_health_monitor {

/// What a task of /diagnostics says.
using Status = diagnostic_updater::DiagnosticStatusWrapper;

/// Tells the terminal when the level of a task of /diagnostics changes: once, with the reason.
class TaskLog {
 public:
  /// @param task  as the lines name it.
  /// @param least  a lower level is reported only when it ends one that was reported.
  /// @param lasting  [s] a level is reported once it has lasted so long by the wall clock. Above 0 a new reason is
  ///        reported, too, once it has lasted as long, if the level is `least` or worse; other numbers in the same
  ///        reason do not make it new.
  explicit TaskLog(const std::string& task, unsigned char least = Status::OK, double lasting = 0.0)
      : task_(task), least_(least), lasting_(lasting) {}

  void note(const Status& status);

 private:
  struct Said {
    unsigned char level;
    std::string reason;  // without numbers; empty where it does not count

    bool operator==(const Said& other) const { return level == other.level && reason == other.reason; }
  };

  Said saidBy(const Status& status) const;

  std::string task_;
  unsigned char least_;
  ros::WallDuration lasting_;
  std::optional<Said> reported_, now_;
  ros::WallTime since_;  // of now_
};

}  // namespace suspension_health_monitor
