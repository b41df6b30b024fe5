#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <optional>
#include <string>

namespace suspension_health_monitor {

/// Tells the terminal when the level of a task of /diagnostics changes: once, with the reason.
class TaskLog {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// @param task  as the lines name it.
  /// @param least  levels below are told only as the end of one that was.
  /// @param lasting  [s] of wall time that a level must last first.
  explicit TaskLog(const std::string& task, unsigned char least = Status::OK, double lasting = 0.0)
      : task_(task), least_(least), lasting_(lasting) {}

  void note(const Status& status);

 private:
  struct Level {
    unsigned char value;
    ros::WallTime since;
  };

  std::string task_;
  unsigned char least_;
  ros::WallDuration lasting_;
  std::optional<unsigned char> told_;
  std::optional<Level> now_;
};

}  // namespace suspension_health_monitor
