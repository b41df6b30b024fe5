#include "imu_topics.h"

#include <utility>

namespace suspension_health_monitor {
namespace {

constexpr std::uint32_t kQueueSize = 100000;  // messages of either IMU that may wait: 100 s at 1 kHz, some 50 MB

}  // namespace

ImuTopics::ImuTopics(const ros::NodeHandle& node, const std::vector<std::string>& topics, bool by_transforms,
                     Receive receive)
    : node_(node), by_transforms_(by_transforms), receive_(std::move(receive)) {
  for (const std::string& topic : topics) imus_.push_back({topic, "", {}});
}

ImuTopics::~ImuTopics() {  // nothing may call back into members that are already gone
  static_transforms_.shutdown();
  stop();
}

void ImuTopics::listen() {
  if (imus_.front().subscriber) return;
  if (by_transforms_ && !static_transforms_)
    static_transforms_ = node_.subscribe("/tf_static", kQueueSize, &ImuTopics::receiveTransforms, this);
  for (std::size_t i = 0; i < imus_.size(); ++i)
    imus_[i].subscriber = node_.subscribe<sensor_msgs::Imu>(
        imus_[i].topic, kQueueSize,
        [this, i](const sensor_msgs::ImuConstPtr& message) {
          imus_[i].frame = message->header.frame_id;
          receive_(i, *message);
        },
        nullptr, ros::TransportHints().tcpNoDelay());
}

void ImuTopics::stop() {
  for (Imu& imu : imus_) {
    imu.subscriber.shutdown();
    imu.subscriber = {};
  }
}

void ImuTopics::receiveTransforms(const tf2_msgs::TFMessageConstPtr& tree) {
  for (const geometry_msgs::TransformStamped& transform : tree->transforms)
    transforms_.setTransform(transform, "/tf_static", true);
}

}  // namespace suspension_health_monitor
