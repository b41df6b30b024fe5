#pragma once

#include <sensor_msgs/Imu.h>
#include <suspension_health_monitor/SimulationTruth.h>

#include <optional>
#include <vector>

#include "simulator_options.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {

/// One instant of a simulated drive as messages; an IMU message that was lost is missing.
struct DriveMessages {
  ros::Time time;
  std::optional<sensor_msgs::Imu> sprung, unsprung;
  SimulationTruth truth;
  std::optional<sensor_msgs::Imu> road;  ///< with road_imu
};

/// @return the stamp that a message of a simulated drive carries. ROS means by 0 that there is none, so a drive that
/// starts there is stamped a nanosecond later. Nothing can be stamped before; only a clock that is set wrong on purpose
/// gets there.
ros::Time stampAt(Stamp stamp);

/// The simulated drive as messages, the same for the simulator nodelet and for `suspension_bag simulate`.
class DriveMessageSource {
 public:
  /// @param start  stamp at the start of the drive.
  DriveMessageSource(const SimulatorOptions& options, Stamp start);

  /// @return the next instant; nothing after the end of the drive.
  std::optional<DriveMessages> next();

 private:
  SimulationTruth toMessage(const DriveTruth& truth, const std_msgs::Header& header) const;
  std::optional<sensor_msgs::Imu> toMessage(const std::optional<AccelerometerReading>& reading,
                                            const char* frame) const;

  void addSway(const Sway& sway, sensor_msgs::Imu& imu) const;

  DriveSimulator simulator_;
  std::vector<ActiveEffect> hidden_;
  std::vector<ActiveMeasurementEffect> hidden_faults_;
  double gravity_;
  bool has_gyro_;
  bool has_road_;
  Stamp start_;
};

}  // namespace suspension_health_monitor
