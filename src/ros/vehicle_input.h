#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <optional>
#include <string>
#include <vector>

#include "input_history.h"
#include "shell_options.h"
#include "vehicle_pipeline.h"

namespace suspension_health_monitor {

/// The task Input of /diagnostics for a vehicle: which sensor is silent, late, or has messages that were kept out, by
/// its topic. Counters run from the start or the last reset; a warning is about what came since the last report.
class VehicleInput {
 public:
  /// @param topics  by VehicleStreams::sensors.
  VehicleInput(const ShellOptions& options, const VehicleStreams& streams, const std::vector<std::string>& topics);

  void noteMessage(std::size_t sensor, const ros::Time& stamp) { sensors_[sensor].arrivals.note(stamp); }

  /// Why the monitor cannot run, once it has found out.
  void setRefusal(const std::string& reason) { refusal_ = reason; }

  /// To be called with a new pipeline: its counters start from 0, and nothing is refused yet.
  void restart();

  /// @param pipeline  nullptr: the positions of the struts are not known yet, and `missing` says why.
  void describe(const VehiclePipeline* pipeline, const std::string& missing, ImuArrivals::Status& status);

 private:
  struct Sensor {
    std::string topic;
    std::optional<double> expected_rate;  // [Hz]
    ImuArrivals arrivals;
    RejectHistory rejected;
  };

  void summarize(const VehiclePipeline* pipeline, const std::string& missing, ImuArrivals::Status& status) const;
  void describeSensor(Sensor& sensor, const VehiclePipeline& pipeline, std::size_t place, ImuArrivals::Status& status);

  std::optional<double> max_lag_;  // [s]
  std::vector<Sensor> sensors_;
  std::string refusal_;
  SeriesHistory series_;
  ClockHistory clock_;
};

}  // namespace suspension_health_monitor
