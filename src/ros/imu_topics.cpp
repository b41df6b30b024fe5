#include "imu_topics.h"

#include <utility>

namespace suspension_health_monitor {
namespace {

constexpr std::uint32_t kQueueSize = 100000;  // messages of either IMU that may wait: 100 s at 1 kHz, some 50 MB
constexpr std::array kTopics{"sprung/imu", "unsprung/imu", "road/imu"};

}  // namespace

ImuTopics::ImuTopics(const ros::NodeHandle& node, const PipelineOptions& options, Receive receive)
    : node_(node),
      by_transforms_(!options.shell.target_frame.empty()),
      num_imus_(options.monitor.tyre ? 3 : 2),
      receive_(std::move(receive)) {}

ImuTopics::~ImuTopics() {  // nothing may call back into members that are already gone
  static_transforms_.shutdown();
  stop();
}

void ImuTopics::listen() {
  if (imus_.front()) return;
  if (by_transforms_ && !static_transforms_)
    static_transforms_ = node_.subscribe("/tf_static", kQueueSize, &ImuTopics::receiveTransforms, this);
  for (std::size_t i = 0; i < num_imus_; ++i)
    imus_[i] = node_.subscribe<sensor_msgs::Imu>(
        kTopics[i], kQueueSize,
        [this, side = static_cast<Side>(i)](const sensor_msgs::ImuConstPtr& imu) {
          if (side == Side::kSprung) body_frame_ = imu->header.frame_id;
          receive_(side, *imu);
        },
        nullptr, ros::TransportHints().tcpNoDelay());
}

void ImuTopics::stop() {
  for (ros::Subscriber& imu : imus_) imu.shutdown();
  imus_ = {};
}

void ImuTopics::receiveTransforms(const tf2_msgs::TFMessageConstPtr& tree) {
  for (const geometry_msgs::TransformStamped& transform : tree->transforms)
    transforms_.setTransform(transform, "/tf_static", true);
}

}  // namespace suspension_health_monitor
