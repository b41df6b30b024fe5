#pragma once

#include <sensor_msgs/Imu.h>

#include <functional>
#include <optional>
#include <vector>

#include "imu_mount.h"
#include "shell_options.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/monitor/strut_pipeline.h"
#include "suspension_health_monitor/internal/signal/recent_samples.h"

namespace suspension_health_monitor {

/// A StrutPipeline of Imu messages: message -> StrutSensors -> StrutPipeline -> sink. It keeps the newest samples, for
/// a search.
class ImuPipeline {
 public:
  using Sink = std::function<void(const MonitorReport&)>;

  /// @param sink  called with the report after every sample that was taken in.
  /// @param transforms  with a target_frame: where those of the IMUs are looked up; outlives this object.
  /// @throws std::invalid_argument  as MonitorOptions::validate().
  ImuPipeline(const PipelineOptions& options, Sink sink, const tf2::BufferCore* transforms);
  ImuPipeline(const ImuPipeline&) = delete;  // its strut's sinks refer to it
  ImuPipeline& operator=(const ImuPipeline&) = delete;

  /// @throws std::invalid_argument  as StrutPipeline::push().
  void push(Side side, const sensor_msgs::Imu& imu);

  StrutPipeline& strut() { return strut_; }
  const StrutPipeline& strut() const { return strut_; }
  const SuspensionMonitor* monitor() const { return strut_.monitor(); }  ///< as there

  static constexpr std::size_t kMostKept = 4000000;  // samples, of 64 bytes each

  /// @return the samples kept, of diagnose_window, that are at most `span` [s] older than the newest one, in the order
  /// of time.
  std::vector<CornerSample> newestSamples(double span) const;

  /// @return likewise what else the body's IMU measured.
  std::vector<BodyMotion> newestBodyMotion(double span) const;

  const ImuMount& mount(Side side) const { return sensors_.mount(side); }

  /// @return everything that was kept out so far, wherever it was noticed.
  RejectCounts rejected() const;

 private:
  void keep(const CornerSample& sample);

  double kept_span_;  // [s]
  StrutSensors sensors_;
  std::optional<RecentSamples> recent_;  // from the first sample on, as is the other
  std::optional<Recent<BodyMotion>> recent_body_;
  StrutPipeline strut_;
};

}  // namespace suspension_health_monitor
