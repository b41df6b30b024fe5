#pragma once

#include <dynamic_reconfigure/server.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <memory>
#include <optional>
#include <string>

#include "imu_pipeline.h"
#include "imu_topics.h"
#include "input_diagnostics.h"
#include "live_settings.h"
#include "live_strut.h"
#include "monitor_thread.h"
#include "strut_search.h"
#include "task_log.h"

namespace suspension_health_monitor {

/// Two IMU topics in; estimates, comparison, health and diagnostics out. One per strut.
/// Every callback comes from one thread, that of all monitors of the process, so nothing here needs a lock; ~diagnose
/// works beside it.
class MonitorNodelet : public nodelet::Nodelet {
 public:
  ~MonitorNodelet() override;

 private:
  /// @throws std::invalid_argument  on a wrong parameter, after logging it: the loader drops the nodelet and lives on.
  void onInit() override;

  void start(ros::NodeHandle node, ros::NodeHandle private_node);
  void tellStart() const;

  LiveStrut::Host host();
  void makePipeline();

  void onImu(Side side, const sensor_msgs::Imu& imu);
  void onReconfigure(LiveSettings& settings);
  std::string reset();
  SearchTask giveSamples(double window) const;
  void takeDiagnosis(const Diagnosis& diagnosis);
  void stopListening(const std::string& reason);

  std::shared_ptr<MonitorThread> thread_ = MonitorThread::ofThisProcess();
  PipelineOptions options_;
  std::optional<LiveStrut> strut_;
  std::optional<ImuTopics> imus_;
  std::optional<ImuPipeline> pipeline_;
  std::optional<InputDiagnostics> input_;
  std::optional<TaskLog> input_log_;
  std::optional<dynamic_reconfigure::Server<LiveSettings>> reconfigure_;
  ros::WallTimer tick_;
};

}  // namespace suspension_health_monitor
