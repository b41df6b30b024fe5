#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/WrenchStamped.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling_output.h"
#include "imu_topics.h"
#include "live_strut.h"
#include "message_topics.h"
#include "monitor_thread.h"
#include "suspension_health_monitor/internal/vehicle/body_inertia.h"
#include "vehicle_input.h"
#include "vehicle_options.h"
#include "vehicle_pipeline.h"
#include "vehicle_search.h"

namespace suspension_health_monitor {

/// All IMUs and known forces of a vehicle in; estimates, comparison and health of every strut out, below the strut's
/// name, and how the struts move one another. Every callback comes from one thread, that of all monitors of the
/// process, so nothing here needs a lock; ~diagnose works beside it.
class VehicleNodelet : public nodelet::Nodelet {
 public:
  ~VehicleNodelet() override;

 private:
  /// @throws std::invalid_argument  on a wrong parameter or vehicle file, after logging it: the loader drops the
  /// nodelet and lives on.
  void onInit() override;

  void start(ros::NodeHandle node, ros::NodeHandle private_node);
  void addStruts();
  LiveStrut::Vehicle servedStrut(std::size_t i);
  void makePipeline();
  void placeStruts();
  VehiclePipeline::Sinks pipelineSinks();

  void onImu(std::size_t imu, const sensor_msgs::Imu& message);
  template <class Message>
  void onMessage(std::size_t sensor, const Message& message);
  void onTick();
  std::string reset();
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  VehicleSearchTask giveSamples(double window) const;
  void takeDiagnosis(const VehicleDiagnosis& found);
  void stopListening(const std::string& reason);

  VehicleMonitor* monitor() { return pipeline_ ? pipeline_->monitor() : nullptr; }
  std::string whyNoMonitor() const;
  const std::string& frameOf(std::size_t strut) const { return imus_->frame(body_imus_[strut]); }

  std::shared_ptr<MonitorThread> thread_ = MonitorThread::ofThisProcess();
  VehicleOptions options_;
  std::optional<VehicleStreams> streams_;  // whose positions may not be known yet
  std::vector<std::size_t> body_imus_;     // by strut its body's IMU, in streams_->sensors
  std::string missing_position_;           // why there is no pipeline
  StrutPlaces places_;                     // empty while they are not known
  std::optional<sensor_msgs::Imu> body_message_;
  std::optional<ImuTopics> imus_;
  std::optional<MessageTopics<geometry_msgs::WrenchStamped>> forces_;
  std::optional<VehiclePipeline> pipeline_;
  ros::Publisher diagnostics_;  // of all updaters
  std::vector<std::unique_ptr<LiveStrut>> struts_;
  std::optional<CouplingOutput> coupling_;
  std::optional<VehicleInput> input_;
  std::optional<diagnostic_updater::Updater> updater_;
  ros::ServiceServer reset_;
  std::optional<DiagnoseService<DiagnoseVehicle>> diagnose_;
  ros::WallTimer tick_;
};

}  // namespace suspension_health_monitor
