#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <array>
#include <functional>
#include <string>

#include "shell_options.h"

namespace suspension_health_monitor {

/// The IMU topics of a strut, and /tf_static if the mounts are told by transforms.
class ImuTopics {
 public:
  using Receive = std::function<void(Side, const sensor_msgs::Imu&)>;

  /// Hears nothing before listen().
  /// @param receive  called for every message.
  ImuTopics(const ros::NodeHandle& node, const PipelineOptions& options, Receive receive);
  ~ImuTopics();

  /// Subscribes, unless it has.
  void listen();
  void stop();

  /// @return the IMUs of body and wheel carrier.
  std::array<ros::Subscriber, 2> strut() const { return {imus_[0], imus_[1]}; }

  /// @return frame_id of the body's IMU; empty before its first message.
  const std::string& bodyFrame() const { return body_frame_; }

  /// @return the static transforms so far.
  const tf2::BufferCore& transforms() const { return transforms_; }

 private:
  void receiveTransforms(const tf2_msgs::TFMessageConstPtr& tree);

  ros::NodeHandle node_;
  bool by_transforms_;
  std::size_t num_imus_;
  Receive receive_;
  std::string body_frame_;
  tf2::BufferCore transforms_;
  ros::Subscriber static_transforms_;
  std::array<ros::Subscriber, kMostStreams> imus_;  // by Side
};

}  // namespace suspension_health_monitor
