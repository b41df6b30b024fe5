#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <suspension_health_monitor/Diagnose.h>

#include <functional>
#include <optional>
#include <string>

#include "diagnose_service.h"
#include "live_baseline.h"
#include "live_model.h"
#include "report_topics.h"
#include "strut_diagnostics.h"
#include "strut_services.h"

namespace suspension_health_monitor {

/// A live strut as others see it, alone or one of a vehicle: its topics, its services and its tasks of /diagnostics.
class LiveStrut {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// What it asks the nodelet for; what changes with its model it does itself.
  struct Host : StrutServices::Strut {
    std::string title;                      ///< of the strut, for the terminal
    std::function<std::string()> why_none;  ///< why the strut has no monitor
    StrutDiagnostics::FindSilent silent_topics;
    std::function<const std::string&()> frame;    ///< frame_id of the body's IMU
    std::function<void(Status&)> describe_input;  ///< of the strut's own sensors
    ros::CallbackQueueInterface* queue;           ///< where all callbacks come from
    DiagnoseService<Diagnose>::Prepare search;
  };

  /// @param name  in its vehicle, below which its topics and services are; empty: it is alone, and they are the node's.
  /// @param model_of  as VehicleOptions has it.
  /// @throws std::invalid_argument  as LiveModel and LiveBaseline.
  LiveStrut(const std::string& name, const PipelineOptions& options, const std::string& model_of, Host host);
  LiveStrut(const LiveStrut&) = delete;
  LiveStrut& operator=(const LiveStrut&) = delete;

  /// Advertises topics and services.
  void start(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

  /// Gives a new monitor the model and the baseline of this strut: by calls as those of StrutServices::Strut.
  template <class SetEffects, class SetBaseline>
  void begin(const SetEffects& set_effects, const SetBaseline& set_baseline) const {
    set_effects(model_.effects(), model_.strutFor(model_.effects()));
    if (baseline_.known()) set_baseline(*baseline_.known());
  }

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
  void keepBaseline();

  std::string name_, prefix_;  // of what is told of it
  PipelineOptions options_;
  Host host_;
  LiveModel model_;
  LiveBaseline baseline_;
  StrutDiagnostics diagnostics_;
  std::optional<ReportTopics> reports_;
  std::optional<StrutServices> services_;
  std::optional<DiagnoseService<Diagnose>> diagnose_;
  std::optional<diagnostic_updater::Updater> updater_;
};

}  // namespace suspension_health_monitor
