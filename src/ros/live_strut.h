#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <suspension_health_monitor/Diagnose.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose_service.h"
#include "live_baseline.h"
#include "live_model.h"
#include "report_topics.h"
#include "strut_diagnostics.h"
#include "strut_services.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_monitor.h"

namespace suspension_health_monitor {

/// One strut of a live vehicle as others see it: topics and services below its name, and its tasks of /diagnostics.
class LiveStrut {
 public:
  /// What it asks the vehicle for.
  struct Vehicle {
    std::function<VehicleMonitor*()> monitor;  ///< nullptr: none yet
    std::function<std::vector<CornerSample>()> newest_samples;
    std::function<std::string()> why_none;  ///< why the strut has no monitor
    StrutDiagnostics::FindSilent silent_topics;
    std::function<const std::string&()> frame;                                         ///< frame_id of the body's IMU
    std::function<void(diagnostic_updater::DiagnosticStatusWrapper&)> describe_input;  ///< of the strut's own sensors
    ros::CallbackQueueInterface* queue;  ///< where all callbacks come from
    DiagnoseService<Diagnose>::Prepare search;
    std::function<std::string()> reset;  ///< of the whole vehicle; tells what it has done
  };

  /// @param place  of the strut in the vehicle.  @param model_of  as VehicleOptions has it.
  /// @throws std::invalid_argument  as LiveModel and LiveBaseline, with the strut's name in front.
  LiveStrut(const std::string& name, std::size_t place, const PipelineOptions& options, const std::string& model_of,
            Vehicle vehicle);
  LiveStrut(const LiveStrut&) = delete;
  LiveStrut& operator=(const LiveStrut&) = delete;

  /// Advertises topics and services.
  void start(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

  /// Gives a new monitor the model and the baseline of this strut.
  void begin(VehicleMonitor& monitor) const;

  /// @pre the vehicle has a monitor.
  void publish(const MonitorReport& report);
  void publishModel();
  void publishDiagnostics() { updater_->force_update(); }

  /// What the last ~diagnose found in it.
  void setDiagnosis(const Diagnosis& diagnosis) { model_.setDiagnosis(diagnosis); }

  const LiveModel& model() const { return model_; }

 private:
  const SuspensionMonitor* monitor() const;
  void keepBaseline();

  std::string name_;
  std::size_t place_;
  PipelineOptions options_;
  Vehicle vehicle_;
  LiveModel model_;
  LiveBaseline baseline_;
  StrutDiagnostics diagnostics_;
  std::optional<ReportTopics> reports_;
  std::optional<StrutServices> services_;
  std::optional<DiagnoseService<Diagnose>> diagnose_;
  std::optional<diagnostic_updater::Updater> updater_;
};

}  // namespace suspension_health_monitor
