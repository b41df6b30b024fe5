#pragma once

#include <sensor_msgs/Imu.h>

#include <functional>
#include <optional>
#include <vector>

#include "shell_options.h"
#include "strut_sensors.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/signal/recent_samples.h"
#include "suspension_health_monitor/internal/signal/uniform_grid.h"

namespace suspension_health_monitor {

/// From Imu messages to reports, the same for the nodelet and for a bag:
/// message -> StrutSensors -> SuspensionMonitor::addSample -> sink.
/// Without a configured sample_period the first readings wait until their stamps have told it.
class ImuPipeline {
 public:
  using Sink = std::function<void(const MonitorReport&)>;

  /// @param sink  called with the report after every sample that was taken in.
  /// @param transforms  with a target_frame: where those of the IMUs are looked up; outlives this object.
  /// @throws std::invalid_argument  as MonitorOptions::validate().
  ImuPipeline(const PipelineOptions& options, Sink sink, const tf2::BufferCore* transforms = nullptr);

  void push(Side side, const sensor_msgs::Imu& imu);

  /// Has these effects in the model from now on, see SuspensionMonitor::setEffects().
  /// @throws std::invalid_argument  as there; while the sample period is being measured, the samples that end this do.
  void setEffects(const std::vector<ActiveEffect>& effects);

  /// Has health judged by this from now on.
  void setBaseline(const Baseline& baseline);

  /// Goes on with other settings, see SuspensionMonitor::reconfigure().
  void reconfigure(MonitorOptions options);

  /// From now on keeps the newest samples: those of `span` [s], at most kMostKept.
  void keepSamples(double span);
  static constexpr std::size_t kMostKept = 4000000;  // 64 bytes each

  /// @return the samples kept that are at most `span` [s] older than the newest one, in the order of time.
  std::vector<CornerSample> newestSamples(double span) const;

  /// @return likewise what else the body's IMU measured.
  std::vector<BodyMotion> newestBodyMotion(double span) const;

  /// @return the monitor; nullptr while the sample period is being measured.
  const SuspensionMonitor* monitor() const { return monitor_ ? &*monitor_ : nullptr; }

  /// @return what follows the tyre; nullptr without tyre/enabled and while the sample period is being measured.
  const TyreTracker* tyre() const { return tyre_ ? &*tyre_ : nullptr; }

  const ImuMount& mount(Side side) const { return sensors_.mount(side); }

  /// @return what passes readings on to the monitor; nullptr while the sample period is being measured.
  const UniformGrid* grid() const { return sensors_.grid(); }

  /// @return everything that was kept out so far, wherever it was noticed.
  RejectCounts rejected() const;

 private:
  void push(const StrutSensors::Reading& reading);
  void keep(const CornerSample& sample);
  void start(double period);

  PipelineOptions options_;
  StrutSensors sensors_;
  Sink sink_;
  PeriodMeasurement measurement_;
  std::vector<StrutSensors::Reading> early_;  // readings that wait for the sample period
  std::optional<SuspensionMonitor> monitor_;
  std::optional<TyreTracker> tyre_;
  std::vector<ActiveEffect> effects_;  // until there is a monitor
  std::optional<Baseline> baseline_;   // until there is a monitor
  std::optional<double> kept_span_;    // [s]
  std::optional<RecentSamples> recent_;
  std::optional<Recent<BodyMotion>> recent_body_;
  RejectCounts rejected_;  // while the sample period is being measured
};

}  // namespace suspension_health_monitor
