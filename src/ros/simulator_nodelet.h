#pragma once

#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <suspension_health_monitor/ParameterEstimate.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "drive_messages.h"

namespace suspension_health_monitor {

/// Publishes a simulated drive: both IMUs, the truth on its own topic, and /clock when asked.
class SimulatorNodelet : public nodelet::Nodelet {
 public:
  ~SimulatorNodelet() override;

 private:
  using Clock = std::chrono::steady_clock;

  /// @throws std::invalid_argument  on a wrong parameter, after logging it: the loader drops the nodelet and lives on.
  void onInit() override;

  void drive(SimulatorOptions options);
  void publishDrive(const SimulatorOptions& options);
  void waitForStart(const PublishingOptions& options) const;
  void waitForTurn(const SimulatorOptions& options, ros::Time start, ros::Time now, Clock::time_point wall_start);
  void publishClock(ros::Time now) const;
  void publish(const DriveMessages& messages, bool publish_clock);

  ros::Publisher sprung_, unsprung_, road_, truth_, clock_;
  ros::Subscriber pace_;
  std::atomic<double> paced_until_{0.0};  // stamp of the newest estimate of the monitor that sets the pace [s]
  std::atomic<bool> running_{true};
  bool pace_is_lost_ = false;  // the drive's thread only
  std::thread thread_;
};

}  // namespace suspension_health_monitor
