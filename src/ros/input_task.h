#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "conversions.h"
#include "input_history.h"
#include "message_pipeline.h"
#include "shell_options.h"
#include "suspension_health_monitor/internal/signal/stream_grid.h"
#include "suspension_health_monitor/internal/signal/stream_silence.h"

namespace suspension_health_monitor {

/// The task Input of /diagnostics, as far as it is the same of one strut and of a vehicle: which sensor is silent or
/// late, and how its readings come onto the grid. Counters run from the start or the last reset; a warning is about
/// what came since the last report.
class InputTask {
 public:
  virtual ~InputTask() = default;

  void noteMessage(std::size_t sensor, const ros::Time& stamp) {
    sensors_[sensor].arrivals.note(stamp);
    silent_.add(sensor, toStamp(stamp));
  }

  /// @return the topics that are silent while others go on.
  std::vector<std::string> silentTopics() const { return silent_.now(); }

  /// To be called with a new pipeline: its counters start from 0, and nothing is refused yet.
  virtual void restart();

  /// Why the monitor cannot run, once it has found out.
  void setRefusal(const std::string& reason) { refusal_ = reason; }

 protected:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  using Sensors = std::vector<std::size_t>;

  struct Sensor {
    std::string name;                     // as the task calls it
    std::optional<double> expected_rate;  // [Hz]
    ImuArrivals arrivals;
  };

  /// @param topics  of the sensors.
  InputTask(const ShellOptions& options, const std::vector<std::string>& topics, std::vector<Sensor> sensors);

  /// @param well  what there is to say if all of the sensors arrive.
  void summarize(const Sensors& sensors, bool has_monitor, const char* well, Status& status) const;

  /// @param monitor, grid  nullptr: none yet.
  void describeGrid(const SuspensionMonitor* monitor, const StreamGrid* grid, Status& status);

  /// @param gate  nullptr: none yet.
  void describeSensor(std::size_t sensor, const StreamGate* gate, Status& status) const;
  void describeSilence(const Sensors& sensors, Status& status);
  void describeMounts(const MessagePipeline& pipeline, Status& status) const;

  std::vector<Sensor> sensors_;
  Sensors all_sensors_;
  ClockHistory clock_;

 private:
  std::optional<double> max_lag_;  // [s]
  StreamSilence silent_;
  PublishedTopics published_;
  std::string refusal_;
  SeriesHistory series_;
};

}  // namespace suspension_health_monitor
