#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <optional>
#include <string>
#include <vector>

#include "conversions.h"
#include "input_history.h"
#include "shell_options.h"
#include "suspension_health_monitor/internal/signal/silent_sensors.h"
#include "vehicle_pipeline.h"

namespace suspension_health_monitor {

/// The task Input of /diagnostics for a vehicle: which sensor is silent, late, or has messages that were kept out, by
/// its topic. Counters run from the start or the last reset; a warning is about what came since the last report.
class VehicleInput {
 public:
  /// @param topics  by VehicleStreams::sensors.
  VehicleInput(const ShellOptions& options, const VehicleStreams& streams, const std::vector<std::string>& topics);

  void noteMessage(std::size_t sensor, const ros::Time& stamp) {
    sensors_[sensor].arrivals.note(stamp);
    silent_.add(sensor, toStamp(stamp));
  }

  /// @return the topics that are silent while others go on.
  std::vector<std::string> silentTopics() const { return silent_.now(); }

  /// Why the monitor cannot run, once it has found out.
  void setRefusal(const std::string& reason) { refusal_ = reason; }

  /// To be called with a new pipeline: its counters start from 0, and nothing is refused yet.
  void restart();

  /// @param pipeline  nullptr: the positions of the struts are not known yet, and `missing` says why.
  void describe(const VehiclePipeline* pipeline, const std::string& missing, ImuArrivals::Status& status);

  /// The same of a strut's own sensors alone, for its task Input.
  void describeStrut(std::size_t strut, const VehiclePipeline* pipeline, const std::string& missing,
                     ImuArrivals::Status& status);

 private:
  struct Sensor {
    std::string topic;
    std::optional<double> expected_rate;  // [Hz]
    ImuArrivals arrivals;
    RejectHistory told_of_vehicle, told_of_strut;  // messages that were kept out, by task
  };

  using Told = RejectHistory Sensor::*;

  void summarize(const std::vector<std::size_t>& sensors, const VehiclePipeline* pipeline, const std::string& missing,
                 ImuArrivals::Status& status) const;
  void describeSensors(const std::vector<std::size_t>& sensors, const VehiclePipeline* pipeline, Told told,
                       ImuArrivals::Status& status);
  void describeSensor(std::size_t sensor, const VehiclePipeline& pipeline, Told told, ImuArrivals::Status& status);

  std::optional<double> max_lag_;  // [s]
  std::vector<Sensor> sensors_;
  std::vector<std::size_t> all_sensors_;
  std::vector<std::vector<std::size_t>> own_sensors_;  // by strut
  SilentSensors silent_;
  PublishedTopics published_;
  std::string refusal_;
  SeriesHistory series_;
  ClockHistory clock_;
};

}  // namespace suspension_health_monitor
