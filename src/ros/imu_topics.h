#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <cstddef>
#include <string>
#include <vector>

#include "message_topics.h"

namespace suspension_health_monitor {

/// The IMU topics of a strut or vehicle, and /tf_static if the mounts are told by transforms.
class ImuTopics {
 public:
  using Receive = MessageTopics<sensor_msgs::Imu>::Receive;

  /// Hears nothing before listen().
  /// @param by_transforms  whether static transforms are needed.
  /// @param receive  called for every message.
  ImuTopics(const ros::NodeHandle& node, const std::vector<std::string>& topics, bool by_transforms, Receive receive);
  ~ImuTopics();

  /// Subscribes, unless it has.
  void listen();
  void stop();

  /// @return the topic's whole name.
  std::string topic(std::size_t imu) const { return imus_.name(imu); }

  /// @return frame_id of the IMU; empty before its first message.
  const std::string& frame(std::size_t imu) const { return frames_[imu]; }

  /// @return the static transforms so far.
  const tf2::BufferCore& transforms() const { return transforms_; }

 private:
  void receiveTransforms(const tf2_msgs::TFMessageConstPtr& tree);

  ros::NodeHandle node_;
  bool by_transforms_;
  std::vector<std::string> frames_;  // by IMU
  tf2::BufferCore transforms_;
  ros::Subscriber static_transforms_;
  MessageTopics<sensor_msgs::Imu> imus_;
};

}  // namespace suspension_health_monitor
