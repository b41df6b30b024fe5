#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace suspension_health_monitor {

/// The IMU topics of a strut or vehicle, and /tf_static if the mounts are told by transforms.
class ImuTopics {
 public:
  /// @param imu  its place among the topics.
  using Receive = std::function<void(std::size_t imu, const sensor_msgs::Imu& message)>;

  /// Hears nothing before listen().
  /// @param by_transforms  whether static transforms are needed.
  /// @param receive  called for every message.
  ImuTopics(const ros::NodeHandle& node, const std::vector<std::string>& topics, bool by_transforms, Receive receive);
  ~ImuTopics();

  /// Subscribes, unless it has.
  void listen();
  void stop();

  /// @return the topic's whole name.
  std::string topic(std::size_t imu) const { return node_.resolveName(imus_[imu].topic); }

  /// @return frame_id of the IMU; empty before its first message.
  const std::string& frame(std::size_t imu) const { return imus_[imu].frame; }

  /// @return the static transforms so far.
  const tf2::BufferCore& transforms() const { return transforms_; }

 private:
  struct Imu {
    std::string topic;
    std::string frame;
    ros::Subscriber subscriber;
  };

  void receiveTransforms(const tf2_msgs::TFMessageConstPtr& tree);

  ros::NodeHandle node_;
  bool by_transforms_;
  Receive receive_;
  tf2::BufferCore transforms_;
  ros::Subscriber static_transforms_;
  std::vector<Imu> imus_;
};

}  // namespace suspension_health_monitor
