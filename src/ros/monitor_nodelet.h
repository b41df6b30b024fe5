#pragma once

#include <dynamic_reconfigure/server.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "input_task.h"
#include "live_curves.h"
#include "live_search.h"
#include "live_settings.h"
#include "live_strut.h"
#include "message_pipeline.h"
#include "monitor_thread.h"
#include "sensor_topics.h"
#include "task_log.h"
#include "vehicle_diagnostics.h"
#include "vehicle_options.h"
#include "vehicle_sensors.h"

namespace suspension_health_monitor {

/// All IMUs and known forces of a vehicle in; estimates, comparison and health of every strut out, below the strut's
/// name, and how the struts move one another. One strut alone is a vehicle with one strut, whose topics are those of
/// the node and whose settings may change while it runs. Every callback comes from one thread, that of all monitors of
/// the process, so nothing here needs a lock; ~diagnose works beside it.
class MonitorNodelet : public nodelet::Nodelet, private StrutHost {
 public:
  ~MonitorNodelet() override;

 private:
  /// @throws std::invalid_argument  on a wrong parameter or vehicle file, after logging it: the loader drops the
  /// nodelet and lives on.
  void onInit() override;

  virtual VehicleOptions optionsFrom(const OptionMap& values) const {
    return VehicleOptions::ofOneStrut(PipelineOptions::fromValues(values));
  }
  bool isAlone() const { return options_.isOneStrut(); }

  void start(ros::NodeHandle node, ros::NodeHandle private_node);
  void startAlone(ros::NodeHandle& private_node);
  void startVehicle(ros::NodeHandle& private_node);
  void addStruts();
  void makePipeline();

  void describeInput(Status& status);
  void onImu(std::size_t imu, const sensor_msgs::Imu& message);
  template <class Message>
  void onMessage(std::size_t sensor, const Message& message);
  void onReconfigure(LiveSettings& settings);
  void onTick();
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  SearchTask samplesFor(double window);
  std::optional<CurveTask> curveTask(Stamp last);
  void takeDiagnosis(const VehicleDiagnosis& found);
  void stopListening(const std::string& reason);

  // As its struts see it:
  MessagePipeline* pipeline() override { return pipeline_ ? &*pipeline_ : nullptr; }
  std::string whyNoMonitor() override { return isAlone() ? kMeasuringPeriod : diagnostics_->whyNoMonitor(pipeline()); }
  std::vector<std::string> silentTopics() const override { return input_->silentTopics(); }
  const std::string& frameOf(std::size_t strut) const override {
    return topics_->frame(placement_->streams().bodyImuOf(strut));
  }
  void describeInput(std::size_t strut, Status& status) override;
  DiagnoseService<Diagnose>::Search searchFor(std::size_t strut, double window) override;
  std::string reset() override;
  MonitorThread& thread() override { return *thread_; }

  std::shared_ptr<MonitorThread> thread_ = MonitorThread::ofThisProcess();
  VehicleOptions options_;
  std::optional<VehiclePlacement> placement_;
  std::optional<SensorTopics> topics_;
  std::optional<MessagePipeline> pipeline_;  // none while the struts have no places
  std::vector<std::unique_ptr<LiveStrut>> struts_;
  std::optional<InputTask> input_;
  std::optional<TaskLog> input_log_;
  ros::WallTimer tick_, body_;
  std::optional<LiveCurves> curves_;
  // Of one strut alone:
  std::optional<dynamic_reconfigure::Server<LiveSettings>> reconfigure_;
  // Of a vehicle:
  std::optional<VehicleDiagnostics> diagnostics_;
  ros::ServiceServer reset_;
  std::optional<DiagnoseService<DiagnoseVehicle>> diagnose_;
};

/// The same of a vehicle that the parameter `vehicle` describes.
class VehicleNodelet : public MonitorNodelet {
 private:
  VehicleOptions optionsFrom(const OptionMap& values) const override { return VehicleOptions::fromValues(values); }
};

}  // namespace suspension_health_monitor
