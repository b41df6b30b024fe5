#pragma once

#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <suspension_health_monitor/ParameterEstimate.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include "drive_messages.h"
#include "drive_recorder.h"
#include "monitor_thread.h"

namespace suspension_health_monitor {

/// Publishes a simulated drive: both IMUs, the truth on its own topic, and /clock when asked.
///
/// The drive never runs far ahead of the monitors in the same process, whatever real_time_factor asks for, so that none
/// of them loses a reading. One in another process does the same by its estimates, if `pace` is remapped to them.
class SimulatorNodelet : public nodelet::Nodelet {
 public:
  ~SimulatorNodelet() override;

 private:
  using Clock = std::chrono::steady_clock;

  /// @throws std::exception  on a wrong parameter, after logging it: the loader drops the nodelet and lives on.
  void onInit() override;

  void drive(const SimulatorOptions& options);
  void publishDrive(const SimulatorOptions& options);
  void closeRecording();
  bool goesOn() const { return running_ && ros::ok(); }
  void waitForStart();
  void waitForRecording();
  void waitForMonitors() const;
  void waitForTurn(const SimulatorOptions& options, ros::Time start, ros::Time now, Clock::time_point wall_start);
  void waitForPace(ros::Time now, double lead);
  void publish(const DriveMessages& messages, bool publish_clock);
  template <class Message>
  void publish(const ros::Publisher& publisher, const ros::Time& time, const Message& message);

  std::shared_ptr<MonitorThread> monitors_ = MonitorThread::ofThisProcess();
  ros::Publisher sprung_, unsprung_, road_, truth_, clock_;
  ros::Subscriber pace_;
  std::atomic<double> paced_until_{0.0};  // stamp of the newest estimate of the monitor that sets the pace [s]
  std::atomic<bool> running_{true};
  std::optional<DriveRecorder> recorder_;
  std::thread thread_;
};

}  // namespace suspension_health_monitor
