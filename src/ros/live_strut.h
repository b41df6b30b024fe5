#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <suspension_health_monitor/SetEffects.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "live_baseline.h"
#include "live_model.h"
#include "live_search.h"
#include "message_pipeline.h"
#include "report_topics.h"
#include "strut_diagnostics.h"

namespace suspension_health_monitor {

/// The nodelet as its struts see it. Everything is called in its queue.
class StrutHost {
 public:
  virtual ~StrutHost() = default;
  virtual MessagePipeline* pipeline() = 0;                            ///< nullptr: none yet
  virtual std::string whyNoMonitor() = 0;                             ///< why the struts have no monitors
  virtual std::vector<std::string> silentTopics() const = 0;          ///< as InputTask
  virtual const std::string& frameOf(std::size_t strut) const = 0;    ///< frame_id of its body's IMU
  virtual void describeInput(std::size_t strut, Status& status) = 0;  ///< of the strut's own sensors
  virtual DiagnoseService<Diagnose>::Search searchFor(std::size_t strut, double window) = 0;
  virtual std::string reset() = 0;      ///< tells what it has done
  virtual MonitorThread& thread() = 0;  ///< that serves it
};

/// A live strut as others see it, alone or one of a vehicle: its topics, its tasks of /diagnostics, and its services,
/// which change or keep what is known of it: set_effects, save_model, save_baseline, reset, diagnose.
class LiveStrut {
 public:
  /// @param host  outlives this object.  @param place  among the struts.
  /// @param title  of the strut, for the terminal.
  /// @throws std::invalid_argument  as LiveModel and LiveBaseline.
  LiveStrut(StrutHost& host, std::size_t place, const VehicleOptions& options, const std::string& title);
  ~LiveStrut();
  LiveStrut(const LiveStrut&) = delete;
  LiveStrut& operator=(const LiveStrut&) = delete;

  /// Advertises topics and services, below the strut's name; of a strut alone they are the node's.
  /// @return where they are.
  ros::NodeHandle start(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

  /// Gives a new monitor the model and the baseline of this strut.
  void begin(MessagePipeline& pipeline) const;

  /// @pre there is a monitor.
  void publish(const MonitorReport& report);
  void publishModel();
  void publishDiagnostics() { updater_->force_update(); }

  /// What the last ~diagnose found in it.
  void setDiagnosis(const Diagnosis& diagnosis) { model_.setDiagnosis(diagnosis); }

  /// As ReportTopics::setStride().
  void setStride(int every) { reports_->setStride(every); }

  const LiveModel& model() const { return model_; }
  const LiveBaseline& baseline() const { return baseline_; }

 private:
  using Trigger = std_srvs::Trigger;

  const SuspensionMonitor* monitor() const;  // nullptr: none yet
  bool onSetEffects(SetEffectsRequest& request, SetEffectsResponse& response);
  std::string saveModel() const;
  std::string saveBaseline();
  std::optional<MotionScale> motionScaleNow() const;
  void keepBaseline();

  StrutHost& host_;
  std::size_t place_;
  std::string name_, prefix_;  // in logs and diagnostics
  PipelineOptions options_;
  LiveModel model_;
  LiveBaseline baseline_;
  StrutDiagnostics diagnostics_;
  std::optional<ReportTopics> reports_;
  std::array<ros::ServiceServer, 4> services_;
  std::optional<DiagnoseService<Diagnose>> diagnose_;
  std::optional<diagnostic_updater::Updater> updater_;
};

}  // namespace suspension_health_monitor
