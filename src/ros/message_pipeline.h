#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Temperature.h>
#include <tf2/buffer_core.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "recent_samples.h"
#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"
#include "suspension_health_monitor/vehicle.h"
#include "vehicle_options.h"
#include "vehicle_sensors.h"

namespace suspension_health_monitor {

/// A VehiclePipeline of messages: message -> VehicleSensors -> VehiclePipeline -> sink. It keeps the newest samples of
/// all struts, for a search.
class MessagePipeline : public VehiclePipeline {
 public:
  /// @param streams  with the positions of all struts that need one.
  /// @param transforms  with a target_frame: where those of the IMUs are looked up; outlives this object.
  /// @param keeps_samples  for newestSamples(): a recording needs none.
  /// @throws std::invalid_argument  as VehiclePipeline.
  MessagePipeline(const VehicleOptions& options, const VehicleStreams& streams, const tf2::BufferCore* transforms,
                  VehicleMonitor::Sink report, bool keeps_samples);

  /// @param sensor  its place in VehicleStreams::sensors.
  /// @throws std::invalid_argument  as VehiclePipeline::push().
  void push(std::size_t sensor, const sensor_msgs::Imu& message);
  void push(std::size_t sensor, const geometry_msgs::WrenchStamped& message);

  /// The temperature of a strut's damper.
  void push(std::size_t strut, const sensor_msgs::Temperature& message);

  /// @return the samples kept, of diagnose_window, that are at most `span` [s] older than the newest one, and of one
  /// strut what else the body's IMU measured; what they have gone through the grid describes.
  VehicleDrive newestSamples(double span) const;

  const VehicleSensors& sensors() const { return sensors_; }

  /// @return messages of a sensor, or of all, that were kept out so far, wherever it was noticed.
  RejectCounts rejected(std::size_t sensor) const;
  RejectCounts rejected() const;

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

  void keep(const VehicleSample& sample);

  std::size_t numStruts() const { return sensors_.streams().channels.struts.size(); }

  VehicleSensors sensors_;
  std::vector<std::string> forces_;
  double kept_span_;                               // [s]
  std::vector<Recent<StrutSample>> recent_;        // by strut, from the first sample on, as are the others
  std::optional<Recent<Forces>> recent_forces_;    // if there are any
  std::optional<Recent<BodyMotion>> recent_body_;  // of one strut
};

}  // namespace suspension_health_monitor
