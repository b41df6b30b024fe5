#pragma once

#include <optional>
#include <vector>

#include "simulated_messages.h"
#include "simulator_options.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {

/// @return the stamp that a message of a simulated drive carries. ROS means by 0 that there is none, so a drive that
/// starts there is stamped a nanosecond later. Nothing can be stamped before; only a clock that is set wrong on purpose
/// gets there.
ros::Time stampAt(Stamp stamp);

inline constexpr const char* kSprungTopic = "sprung/imu";
inline constexpr const char* kUnsprungTopic = "unsprung/imu";
inline constexpr const char* kRoadTopic = "road/imu";
inline constexpr const char* kTruthTopic = "~truth";

/// @return all topics of such a drive, each with an empty message.
MessagesOnTopics topicsOf(const SimulatorOptions& options);

/// The simulated drive of one strut as messages, the same for the simulator nodelet and for `suspension_bag simulate`.
class DriveMessageSource : public DriveSource {
 public:
  /// @param start  stamp at the start of the drive.
  DriveMessageSource(const SimulatorOptions& options, Stamp start);

  std::optional<SimulatedInstant> next() override;

 private:
  SimulationTruth toMessage(const DriveTruth& truth, const std_msgs::Header& header) const;
  std::optional<sensor_msgs::Imu> toMessage(const std::optional<AccelerometerReading>& reading, double gravity,
                                            const char* frame) const;

  void addSway(const Sway& sway, sensor_msgs::Imu& imu) const;

  DriveSimulator simulator_;
  std::vector<ActiveEffect> hidden_;
  std::vector<ActiveMeasurementEffect> hidden_faults_;
  double gravity_, sprung_gravity_;
  bool has_gyro_;
  bool has_road_;
  Stamp start_;
};

}  // namespace suspension_health_monitor
