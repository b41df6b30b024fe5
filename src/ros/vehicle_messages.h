#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <suspension_health_monitor/SimulationTruth.h>
#include <suspension_health_monitor/VehicleSimulationTruth.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vehicle_simulation_options.h"

namespace suspension_health_monitor {

/// One instant of a simulated drive of a vehicle as messages with their topics, without a slash in front; an IMU
/// message that was lost is missing.
struct VehicleMessages {
  template <class Message>
  using OnTopics = std::vector<std::pair<std::string, Message>>;

  ros::Time time;
  OnTopics<sensor_msgs::Imu> imus;
  OnTopics<geometry_msgs::WrenchStamped> wrenches;
  OnTopics<SimulationTruth> strut_truths;  ///< simulator/NAME/truth
  OnTopics<VehicleSimulationTruth> truth;  ///< simulator/truth

  /// Calls use(topic, message) for every one.
  template <class Use>
  void forEach(const Use& use) const {
    for (const auto& [topic, message] : imus) use(topic, message);
    for (const auto& [topic, message] : wrenches) use(topic, message);
    for (const auto& [topic, message] : strut_truths) use(topic, message);
    for (const auto& [topic, message] : truth) use(topic, message);
  }
};

/// The simulated drive of a vehicle as messages.
class VehicleMessageSource {
 public:
  /// @param start  stamp at the start of the drive.
  VehicleMessageSource(const VehicleSimulationOptions& options, Stamp start);

  /// @return the next instant; nothing after the end of the drive.
  std::optional<VehicleMessages> next();

 private:
  void addImus(const VehicleInstant& sample, VehicleMessages& messages) const;
  void addTruth(const VehicleInstant& sample, VehicleMessages& messages) const;
  std_msgs::Header headerOf(Stamp stamp, const std::string& frame) const;

  VehicleSimulationOptions options_;
  VehicleSimulator simulator_;
  Stamp start_;
};

}  // namespace suspension_health_monitor
