#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <suspension_health_monitor/SimulationTruth.h>
#include <suspension_health_monitor/VehicleSimulationTruth.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "simulator_options.h"
#include "suspension_health_monitor/drive.h"

namespace suspension_health_monitor {

/// A message of a simulated drive.
using SimulatedMessage =
    std::variant<sensor_msgs::Imu, geometry_msgs::WrenchStamped, SimulationTruth, VehicleSimulationTruth>;

/// Messages with their topics, as `front_left/sprung/imu`, or `~truth` below the simulator's own name.
using MessagesOnTopics = std::vector<std::pair<std::string, SimulatedMessage>>;

inline constexpr const char* kTruthTopic = "~truth";

/// One instant of a simulated drive; a message that was lost is missing.
struct SimulatedInstant {
  ros::Time time;
  MessagesOnTopics messages;
};

/// A simulated drive, instant by instant: returns the next; nothing after the end of the drive.
using DriveSource = std::function<std::optional<SimulatedInstant>()>;

/// What the simulator's nodelet and `suspension_bag simulate` have to know of a drive: of one strut, or of a whole
/// vehicle.
struct SimulatedDrive {
  PlayingOptions playing;
  double duration = 0.0;             ///< [s]
  double rate = 0.0;                 ///< of the fastest sensor [Hz]
  MessagesOnTopics topics;           ///< all that it has, each with a message of its type
  std::vector<std::string> awaited;  ///< topics that somebody must listen to before the drive begins
  std::function<DriveSource(Stamp start)> begin;
};

/// The drive of one strut: sprung/imu, unsprung/imu, ~truth and, with a third IMU, road/imu.
SimulatedDrive driveOf(const SimulatorOptions& options);

/// The drive of a vehicle: of every strut NAME/sprung/imu, NAME/unsprung/imu and ~NAME/truth, of the body imu/data and
/// ~truth, of every known force NAME/wrench.
SimulatedDrive driveOf(const VehicleSimulationOptions& options);

/// @param values  those of `options simulator`, or with a vehicle_model those of `options vehicle`.
/// @throws std::invalid_argument  naming an unknown name, or a value that is wrong and what is allowed.
SimulatedDrive makeSimulatedDrive(OptionMap values);

/// Takes the option `vehicle_model` out of `values`.
/// @return empty: a drive of one strut.
std::string takeVehicleModel(OptionMap& values);

}  // namespace suspension_health_monitor
