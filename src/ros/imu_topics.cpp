#include "imu_topics.h"

#include <utility>

namespace suspension_health_monitor {
namespace {

constexpr std::uint32_t kQueueSize = 100000;  // messages with transforms

}  // namespace

ImuTopics::ImuTopics(const ros::NodeHandle& node, const std::vector<std::string>& topics, bool by_transforms,
                     Receive receive)
    : node_(node),
      by_transforms_(by_transforms),
      frames_(topics.size()),
      imus_(node, topics, [this, receive = std::move(receive)](std::size_t imu, const sensor_msgs::Imu& message) {
        frames_[imu] = message.header.frame_id;
        receive(imu, message);
      }) {}

ImuTopics::~ImuTopics() {  // nothing may call back into members that are already gone
  static_transforms_.shutdown();
  stop();
}

void ImuTopics::listen() {
  if (by_transforms_ && !static_transforms_)
    static_transforms_ = node_.subscribe("/tf_static", kQueueSize, &ImuTopics::receiveTransforms, this);
  imus_.listen();
}

void ImuTopics::stop() { imus_.stop(); }

void ImuTopics::receiveTransforms(const tf2_msgs::TFMessageConstPtr& tree) {
  for (const geometry_msgs::TransformStamped& transform : tree->transforms)
    transforms_.setTransform(transform, "/tf_static", true);
}

}  // namespace suspension_health_monitor
