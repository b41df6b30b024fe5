#include "sensor_topics.h"

#include <cstdint>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

constexpr std::uint32_t kQueueSize = 100000;  // messages that may wait: 100 s at 1 kHz, of IMUs some 50 MB

SensorTopics::SensorTopics(const ros::NodeHandle& node, const VehicleStreams& streams,
                           const std::vector<std::string>& thermometers, bool by_transforms, const Sinks& sinks)
    : node_(node),
      sensors_(streams.sensors),
      thermometers_(thermometers),
      by_transforms_(by_transforms),
      sinks_(sinks) {}

void SensorTopics::listen() {
  if (by_transforms_ && !static_transforms_)
    static_transforms_ = node_.subscribe("/tf_static", kQueueSize, &SensorTopics::receiveTransforms, this);
  if (!subscribers_.empty()) return;
  for (std::size_t i = 0; i < sensors_.size(); ++i)
    sensors_[i].place == VehicleStreams::Place::kForce ? subscribe(sensors_[i].topic, i, sinks_.force)
                                                       : subscribe(sensors_[i].topic, i, sinks_.imu);
  for (std::size_t i = 0; i < thermometers_.size(); ++i)
    if (!thermometers_[i].empty()) subscribe(thermometers_[i], i, sinks_.temperature);
}

template <class Message>
void SensorTopics::subscribe(const std::string& topic, std::size_t place, const Receive<Message>& receive) {
  subscribers_.push_back(node_.subscribe<Message>(
      topic, kQueueSize,
      [place, &receive](const boost::shared_ptr<const Message>& message) { receive(place, *message); }, nullptr,
      ros::TransportHints().tcpNoDelay()));
}

void SensorTopics::stop() {
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
  subscribers_.clear();
}

std::vector<std::string> SensorTopics::names() const {
  return mapped(sensors_, [this](const VehicleStreams::Sensor& sensor) { return node_.resolveName(sensor.topic); });
}

void SensorTopics::receiveTransforms(const tf2_msgs::TFMessageConstPtr& tree) {
  for (const geometry_msgs::TransformStamped& transform : tree->transforms)
    transforms_.setTransform(transform, "/tf_static", true);
}

}  // namespace suspension_health_monitor
