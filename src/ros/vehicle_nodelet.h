#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "imu_topics.h"
#include "live_strut.h"
#include "message_topics.h"
#include "monitor_thread.h"
#include "vehicle_diagnostics.h"
#include "vehicle_options.h"
#include "vehicle_pipeline.h"
#include "vehicle_placement.h"
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
  LiveStrut::Host hostOf(std::size_t i);
  std::vector<std::string> topics() const;
  void makePipeline();
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
  const VehiclePipeline* pipeline() const { return pipeline_ ? &*pipeline_ : nullptr; }

  std::shared_ptr<MonitorThread> thread_ = MonitorThread::ofThisProcess();
  VehicleOptions options_;
  std::optional<VehiclePlacement> placement_;
  std::optional<ImuTopics> imus_;
  std::optional<MessageTopics<geometry_msgs::WrenchStamped>> forces_;
  std::optional<VehiclePipeline> pipeline_;  // none while the struts have no places
  std::vector<std::unique_ptr<LiveStrut>> struts_;
  std::optional<VehicleDiagnostics> diagnostics_;
  ros::ServiceServer reset_;
  std::optional<DiagnoseService<DiagnoseVehicle>> diagnose_;
  ros::WallTimer tick_;
};

}  // namespace suspension_health_monitor
