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
#include "live_baseline.h"
#include "live_model.h"
#include "live_settings.h"
#include "monitor_diagnostics.h"
#include "monitor_thread.h"
#include "report_topics.h"
#include "strut_search.h"
#include "strut_services.h"

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

  void onImu(Side side, const sensor_msgs::Imu& imu);
  void publish(const MonitorReport& report);
  void onTick();
  void onReconfigure(LiveSettings& settings);
  std::string reset();
  void keepBaseline();
  SearchTask giveSamples(double window) const;
  void takeDiagnosis(const Diagnosis& diagnosis);
  void publishModel();
  void advertiseServices(ros::NodeHandle& private_node);
  void makePipeline();
  void stopListening(const std::string& reason);

  std::shared_ptr<MonitorThread> thread_ = MonitorThread::ofThisProcess();
  PipelineOptions options_;
  std::optional<LiveModel> model_;
  std::optional<LiveBaseline> baseline_;
  std::optional<ImuTopics> imus_;
  std::optional<ImuPipeline> pipeline_;
  std::optional<ReportTopics> reports_;
  std::optional<MonitorDiagnostics> diagnostics_;
  std::optional<StrutServices> services_;
  std::optional<dynamic_reconfigure::Server<LiveSettings>> reconfigure_;
  std::optional<DiagnoseService<Diagnose>> diagnose_;
  ros::WallTimer tick_;
};

}  // namespace suspension_health_monitor
