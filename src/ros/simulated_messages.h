#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <suspension_health_monitor/SimulationTruth.h>
#include <suspension_health_monitor/VehicleSimulationTruth.h>

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace suspension_health_monitor {

/// A message of a simulated drive.
using SimulatedMessage =
    std::variant<sensor_msgs::Imu, geometry_msgs::WrenchStamped, SimulationTruth, VehicleSimulationTruth>;

/// Messages with their topics, as `front_left/sprung/imu`, or `~truth` below the simulator's own name.
using MessagesOnTopics = std::vector<std::pair<std::string, SimulatedMessage>>;

/// One instant of a simulated drive; a message that was lost is missing.
struct SimulatedInstant {
  ros::Time time;
  MessagesOnTopics messages;
};

/// A simulated drive, instant by instant.
class DriveSource {
 public:
  virtual ~DriveSource() = default;

  /// @return the next instant; nothing after the end of the drive.
  virtual std::optional<SimulatedInstant> next() = 0;
};

}  // namespace suspension_health_monitor
