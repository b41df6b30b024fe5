#pragma once

#include <ros/ros.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace suspension_health_monitor {

/// Topics of one kind of message, whose sensors stream.
template <class Message>
class MessageTopics {
 public:
  /// @param topic  its place among the topics.
  using Receive = std::function<void(std::size_t topic, const Message& message)>;

  /// Hears nothing before listen().
  /// @param topics  an empty one is none.
  /// @param receive  called for every message.
  MessageTopics(const ros::NodeHandle& node, std::vector<std::string> topics, Receive receive)
      : node_(node), topics_(std::move(topics)), receive_(std::move(receive)) {}
  ~MessageTopics() { stop(); }  // nothing may call back into members that are already gone
  MessageTopics(const MessageTopics&) = delete;
  MessageTopics& operator=(const MessageTopics&) = delete;

  /// Subscribes, unless it has.
  void listen() {
    if (!subscribers_.empty()) return;
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      if (topics_[i].empty()) continue;
      subscribers_.push_back(node_.subscribe<Message>(
          topics_[i], kQueueSize, [this, i](const boost::shared_ptr<const Message>& message) { receive_(i, *message); },
          nullptr, ros::TransportHints().tcpNoDelay()));
    }
  }

  void stop() {
    for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
    subscribers_.clear();
  }

  /// @return the topic's whole name.
  std::string name(std::size_t topic) const { return node_.resolveName(topics_[topic]); }

 private:
  static constexpr std::uint32_t kQueueSize = 100000;  // messages that may wait: 100 s at 1 kHz, of IMUs some 50 MB

  ros::NodeHandle node_;
  std::vector<std::string> topics_;
  Receive receive_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace suspension_health_monitor
