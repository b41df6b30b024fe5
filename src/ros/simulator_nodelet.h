#pragma once

#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <suspension_health_monitor/ParameterEstimate.h>

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "drive_recorder.h"
#include "monitor_thread.h"
#include "simulated_drive.h"

namespace suspension_health_monitor {

/// Publishes a simulated drive, of one strut or of a whole vehicle: its IMUs, the truth below its own name, and /clock
/// when asked.
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

  void drive(const SimulatedDrive& drive);
  void publishDrive(const SimulatedDrive& drive);
  void closeRecording();
  bool goesOn() const { return running_ && ros::ok(); }
  void waitForStart(const std::vector<std::string>& awaited);
  void waitForRecording();
  void waitForMonitors() const;
  void waitForTurn(const SimulatedDrive& drive, ros::Time start, ros::Time now, Clock::time_point wall_start);
  void waitForPace(ros::Time now, double lead);
  void publish(const SimulatedInstant& instant);
  ros::Publisher advertise(const std::string& topic, const SimulatedMessage& message);

  std::shared_ptr<MonitorThread> monitors_ = MonitorThread::ofThisProcess();
  std::map<std::string, ros::Publisher> publishers_;  // by topic as SimulatedInstant has it
  std::optional<ros::Publisher> clock_;
  std::atomic<double> paced_until_{0.0};  // stamp of the newest estimate of the monitor that sets the pace [s]
  ros::Subscriber pace_;                  // writes it
  std::atomic<bool> running_{true};
  std::optional<DriveRecorder> recorder_;
  std::thread thread_;
};

}  // namespace suspension_health_monitor
