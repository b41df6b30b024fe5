#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Temperature.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/vehicle_layout.h"

namespace suspension_health_monitor {

/// The topics of a vehicle's sensors and thermometers, and /tf_static if transforms give the mounts.
class SensorTopics {
 public:
  template <class Message>
  using Receive = std::function<void(std::size_t place, const Message& message)>;

  /// What is called for every message, with the sensor's place in VehicleStreams::sensors, or that of the strut.
  struct Sinks {
    Receive<sensor_msgs::Imu> imu;
    Receive<geometry_msgs::WrenchStamped> force;
    Receive<sensor_msgs::Temperature> temperature;
  };

  /// Hears nothing before listen().
  /// @param thermometers  topics by strut; an empty one is none.
  /// @param by_transforms  whether static transforms are needed.
  SensorTopics(const ros::NodeHandle& node, const VehicleStreams& streams, const std::vector<std::string>& thermometers,
               bool by_transforms, const Sinks& sinks);

  /// Subscribes, unless it has.
  void listen();
  void stop();

  /// @return the topics' whole names, by sensor.
  std::vector<std::string> names() const;

  /// @return the static transforms so far.
  const tf2::BufferCore& transforms() const { return transforms_; }

 private:
  template <class Message>
  void subscribe(const std::string& topic, std::size_t place, const Receive<Message>& receive);
  void receiveTransforms(const tf2_msgs::TFMessageConstPtr& tree);

  ros::NodeHandle node_;
  std::vector<VehicleStreams::Sensor> sensors_;
  std::vector<std::string> thermometers_;
  bool by_transforms_;
  Sinks sinks_;
  tf2::BufferCore transforms_;
  // Last, and so gone first: they call back into what is above.
  ros::Subscriber static_transforms_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace suspension_health_monitor
