#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <suspension_health_monitor/SetEffects.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "live_baseline.h"
#include "live_model.h"
#include "live_search.h"
#include "monitor_host.h"
#include "strut_diagnostics.h"
#include "task_log.h"

namespace suspension_health_monitor {

/// A live strut as others see it, alone or one of a vehicle. Topics: estimate, ls, la, comparison and health, of every
/// publish_every-th sample; model, latched, when it changes. Tasks of /diagnostics. Services: set_effects, save_model,
/// save_baseline, reset, diagnose.
class LiveStrut {
 public:
  /// @param host  outlives this object.  @param place  among the struts.
  /// @param node_name  of the nodelet: what a strut alone is called in the terminal.
  /// @throws std::invalid_argument  as LiveModel and LiveBaseline.
  LiveStrut(MonitorHost& host, std::size_t place, const VehicleOptions& options, const std::string& node_name);

  /// Advertises topics and services, below the strut's name; of a strut alone they are the node's.
  /// @return where they are.
  ros::NodeHandle start(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

  /// Gives a new monitor the model and the baseline of this strut.
  void begin(MessagePipeline& pipeline) const;

  /// Publishes what has subscribers, of every publish_every-th report.
  /// @pre there is a monitor.
  void publish(const MonitorReport& report);

  /// The model is another one from now on.
  void publishModel();
  void publishDiagnostics() { updater_->force_update(); }

  /// @param every  so many reports make one publication, >= 1.
  void setStride(int every) { stride_ = static_cast<std::uint64_t>(every); }

  LiveModel& model() { return model_; }
  const LiveBaseline& baseline() const { return baseline_; }

 private:
  using Trigger = std_srvs::Trigger;

  /// When a reading was accepted last, as seen from the reports.
  struct Accepted {
    std::uint64_t samples = 0;
    ros::Time at;
  };

  const SuspensionMonitor* monitor() const { return host_.monitor(place_); }  // nullptr: none yet
  bool onSetEffects(SetEffectsRequest& request, SetEffectsResponse& response);
  std::string saveModel() const;
  std::string saveBaseline();
  std::optional<MotionScale> motionScaleNow() const;
  void keepBaseline();
  void addTasks();
  void describeSilence(Status& status);

  MonitorHost& host_;
  std::size_t place_;
  std::string name_, prefix_;  // in logs and diagnostics
  PipelineOptions options_;
  LiveModel model_;
  LiveBaseline baseline_;
  TaskLog health_log_;
  DriveSummary drive_;
  std::optional<HealthLevel> level_;
  std::optional<Accepted> accepted_;
  std::uint64_t stride_ = 1, reports_ = 0;
  ros::Publisher estimate_, ls_, la_, comparison_, health_, model_topic_;
  bool model_has_estimate_ = false;  // as it was published
  // Last, and so gone first: they call back into what is above.
  std::array<ros::ServiceServer, 4> services_;
  std::optional<DiagnoseService<Diagnose>> diagnose_;
  std::optional<diagnostic_updater::Updater> updater_;
};

}  // namespace suspension_health_monitor
