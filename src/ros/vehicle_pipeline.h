#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/signal/early_readings.h"
#include "suspension_health_monitor/internal/signal/recent_samples.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_streams.h"
#include "suspension_health_monitor/vehicle.h"
#include "vehicle_options.h"
#include "vehicle_sensors.h"

namespace suspension_health_monitor {

/// From the messages of a vehicle's sensors to reports by strut:
/// message -> VehicleSensors -> VehicleGrid -> VehicleMonitor::addSample -> sinks.
/// Without a sample_period the first messages wait until their stamps have told it; until then there is no monitor. It
/// keeps the newest samples of all struts, for a search.
class VehiclePipeline {
 public:
  struct Sinks {
    std::function<void(VehicleMonitor& monitor)> begin;  ///< before the first sample
    VehicleMonitor::Sink report;
  };

  /// @param streams  with the positions of all struts that need one.
  /// @param transforms  with a target_frame: where those of the IMUs are looked up; outlives this object.
  /// @throws std::invalid_argument  as VehicleMonitor.
  VehiclePipeline(const VehicleOptions& options, const VehicleStreams& streams, const tf2::BufferCore* transforms,
                  Sinks sinks);
  VehiclePipeline(const VehiclePipeline&) = delete;  // its monitor's sink refers to it
  VehiclePipeline& operator=(const VehiclePipeline&) = delete;

  /// @param sensor  its place in VehicleStreams::sensors.
  /// @throws std::invalid_argument  if the options do not fit what was measured, the sample period or the struts: no
  /// message is to come any more.
  void push(std::size_t sensor, const sensor_msgs::Imu& message);
  void push(std::size_t sensor, const geometry_msgs::WrenchStamped& message);

  /// After the last message of a recording.
  void finish();

  /// @return nullptr while the sample period is being measured; so with the grid.
  VehicleMonitor* monitor() { return monitor_ ? &*monitor_ : nullptr; }
  const VehicleMonitor* monitor() const { return monitor_ ? &*monitor_ : nullptr; }
  const VehicleGrid* grid() const { return grid_ ? &*grid_ : nullptr; }

  std::optional<double> period() const { return period_; }  ///< T [s]; nothing while it is being measured

  /// @return stamp of the newest sample; 0 before the first.
  Stamp newest() const { return newest_; }

  /// @return the samples kept, of diagnose_window, that are at most `span` [s] older than the newest one; what they
  /// have gone through the grid describes.
  VehicleDrive newestSamples(double span) const;

  /// @return messages of a sensor that were kept out so far, wherever it was noticed.
  RejectCounts rejected(std::size_t sensor) const;

 private:
  /// One strut's part of a sample.
  struct StrutSample : CornerSample {
    std::optional<double> unfiltered;  // LowPass::unfiltered
  };

  /// The known forces of a sample.
  struct Forces {
    Stamp stamp{};
    ForceVector values;
  };

  void push(std::size_t sensor, Stamp stamp, const std::vector<double>& values);
  void start(double period);
  void take(const VehicleSample& sample);

  VehicleOptions options_;
  VehicleStreams streams_;
  Sinks sinks_;
  VehicleSensors sensors_;
  EarlyReadings<std::vector<double>> early_;  // by sensor
  std::optional<double> period_;
  Stamp newest_{};
  std::optional<VehicleGrid> grid_;
  std::optional<VehicleMonitor> monitor_;
  std::vector<Recent<StrutSample>> recent_;      // by strut
  std::optional<Recent<Forces>> recent_forces_;  // if there are any
};

}  // namespace suspension_health_monitor
