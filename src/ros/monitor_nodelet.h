#pragma once

#include <dynamic_reconfigure/server.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Trigger.h>
#include <tf2/buffer_core.h>

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
#include "monitor_host.h"
#include "monitor_thread.h"
#include "vehicle_diagnostics.h"
#include "vehicle_options.h"
#include "vehicle_sensors.h"

namespace suspension_health_monitor {

/// All IMUs and known forces of a vehicle in; estimates, comparison and health of every strut out, below the strut's
/// name, and how the struts move one another. One strut alone is a vehicle with one strut, whose topics are those of
/// the node and whose settings may change while it runs. Every callback comes from one thread, that of all monitors of
/// the process, so nothing here needs a lock; ~diagnose works beside it.
class MonitorNodelet : public nodelet::Nodelet, public MonitorHost {
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
  /// @return the streams with the struts in their places, as the vehicle file says, or by static transforms from the
  /// frame of the body's IMU, which only its messages tell; none as long as a frame has not been found: why_no_places_.
  std::optional<VehicleStreams> placedStreams();
  void makePipeline();

  /// Subscribes to sensors and thermometers, unless it has already; and to /tf_static if transforms give mounts or
  /// places.
  void listen();
  template <class Message, class Receive>
  ros::Subscriber subscribe(const std::string& topic, const Receive& receive);
  std::vector<std::string> topicNames() const;  // resolved, by sensor

  void onImu(std::size_t imu, const sensor_msgs::Imu& message);
  template <class Message>
  void onMessage(std::size_t sensor, const Message& message);
  void onReconfigure(LiveSettings& settings);
  void onTick();

  // As its parts see it:
  MonitorThread& thread() override { return *thread_; }
  MessagePipeline* pipeline() override { return pipeline_ ? &*pipeline_ : nullptr; }
  std::string whyNoMonitor() override;
  InputTask& input() override { return *input_; }
  const std::string& frameOf(std::size_t strut) const override { return frames_[streams_->bodyImuOf(strut)]; }
  SearchTask samplesFor(double window) override;
  void takeDiagnosis(const VehicleDiagnosis& found) override;
  std::string reset() override;

  std::shared_ptr<MonitorThread> thread_ = MonitorThread::ofThisProcess();
  VehicleOptions options_;
  std::optional<VehicleStreams> streams_;         // as streamsAnywhere()
  std::optional<sensor_msgs::Imu> body_message_;  // the newest before there is a pipeline
  std::string why_no_places_ = "waiting for body_imu, whose frame tells the struts' positions";
  tf2::BufferCore transforms_;               // the static ones so far
  std::optional<MessagePipeline> pipeline_;  // none while the struts have no places
  std::optional<InputTask> input_;
  std::vector<std::string> frames_;                // by sensor, of its newest message; empty before the first
  std::optional<VehicleDiagnostics> diagnostics_;  // of a vehicle
  // What calls back is last, and so gone first: nothing may call back into members that are already gone.
  std::vector<std::unique_ptr<LiveStrut>> struts_;
  ros::ServiceServer reset_;  // of a vehicle
  ros::Subscriber static_transforms_;
  std::vector<ros::Subscriber> subscribers_;  // to sensors and thermometers
  ros::WallTimer body_, tick_;                // of a vehicle; of all
  std::optional<LiveCurves> curves_;
  std::optional<DiagnoseService<DiagnoseVehicle>> diagnose_;              // of a vehicle
  std::optional<dynamic_reconfigure::Server<LiveSettings>> reconfigure_;  // of one strut alone
};

/// The same of a vehicle that the parameter `vehicle` describes.
class VehicleNodelet : public MonitorNodelet {
 private:
  VehicleOptions optionsFrom(const OptionMap& values) const override { return VehicleOptions::fromValues(values); }
};

}  // namespace suspension_health_monitor
