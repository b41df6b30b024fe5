#pragma once

#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arrivals.h"
#include "monitor_host.h"
#include "suspension_health_monitor/internal/signal/stream_silence.h"
#include "task_log.h"
#include "vehicle_options.h"

namespace suspension_health_monitor {

/// Why a strut has no monitor at first.
inline constexpr const char* kMeasuringPeriod = "measuring the sample period";

/// The task Input of /diagnostics, of a vehicle and of each of its struts: which sensor is silent or late, how its
/// readings come onto the grid, and which were kept out. Sensors are named by their topics, those of a strut alone by
/// their place. Counters run from the start or the last reset; a warning is about what came since the last report.
class InputTask {
 public:
  /// @param host  outlives this object.  @param name  of the nodelet, for the terminal.
  /// @param topics  by VehicleStreams::sensors.
  InputTask(MonitorHost& host, const std::string& name, const VehicleOptions& options, const VehicleStreams& streams,
            const std::vector<std::string>& topics);

  void noteMessage(std::size_t sensor, const ros::Time& stamp);

  /// @return the topics that are silent while others go on.
  std::vector<std::string> silentTopics() const { return silent_.now(); }

  /// To be called with a new pipeline: its counters start from 0, and nothing is refused yet.
  void restart();

  /// Why the monitor cannot run, once it has found out.
  void setRefusal(const std::string& reason) { refusal_ = reason; }

  void describe(Status& status);

  /// The same of a strut's own sensors alone, in a vehicle.
  void describeStrut(std::size_t strut, Status& status);

 private:
  struct Sensor {
    std::string name;                     // as the task calls it
    std::optional<double> expected_rate;  // [Hz]
    Arrivals arrivals;
  };
  using Sensors = std::vector<std::size_t>;
  using Rejected = std::vector<RejectCounts>;  // of the last report: by sensor, of a strut alone of both IMUs

  void summarize(const Sensors& sensors, Status& status) const;
  void describeSeries(const MessagePipeline& pipeline, Status& status);
  void describeSensors(const Sensors& sensors, const MessagePipeline& pipeline, Rejected& before, Status& status);
  void describeSilence(const Sensors& sensors, Status& status);
  void describeClock(Status& status);

  MonitorHost& host_;
  bool is_alone_;
  std::vector<Sensor> sensors_;
  Sensors all_sensors_;
  std::vector<Sensors> own_sensors_;  // by strut
  std::string target_frame_;
  std::optional<double> max_lag_;  // [s]
  StreamSilence silent_;
  TaskLog log_;
  PublishedTopics published_;
  std::string refusal_;
  std::uint64_t gaps_before_ = 0;
  Rejected reported_of_vehicle_, reported_of_strut_;
  std::optional<ros::Time> clock_;  // at the last report
};

}  // namespace suspension_health_monitor
