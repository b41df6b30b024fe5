#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "monitor_thread.h"
#include "whole_bag.h"

namespace suspension_health_monitor {

/// Records a simulated drive into a bag that has every message, however fast the drive and however busy the machine.
///
/// The simulator hands over its own messages. Those of others are handed over by the thread that serves the monitors of
/// this process, before it is idle (MonitorThread::isIdle): whoever waits for that between two parts of the drive loses
/// none. A monitor in another process is recorded as far as it keeps up.
class DriveRecorder {
 public:
  /// @param topics  names with spaces between them.
  /// @throws std::runtime_error  if the file cannot be written.
  DriveRecorder(const ros::NodeHandle& node, const std::string& path, const std::string& topics);

  /// Subscribes to what is published by now and to be recorded.
  /// @param own  topics whose messages come by record().
  /// @return the topics that nobody publishes yet.
  /// @throws std::invalid_argument  naming a topic of a type that cannot be recorded.
  std::vector<std::string> connect(const std::vector<std::string>& own);

  /// Writes a message if its topic is to be recorded. What goes wrong is reported by commit().
  template <class Message>
  void record(const std::string& topic, const ros::Time& time, const Message& message) {
    if (topics_.count(topic) != 0) guarded([&] { bag_.write(topic, time, message), ++count_; });
  }

  /// Puts the bag in place, unless it is empty.
  /// @return how many messages it has.
  /// @throws std::runtime_error  naming the file, if anything could not be written.
  std::size_t commit();

 private:
  /// @return false if the topic has another type.
  template <class Message>
  bool subscribe(const std::string& topic, const std::string& type);
  template <class... Messages>
  bool subscribeToOneOf(const std::string& topic, const std::string& type) {
    return (subscribe<Messages>(topic, type) || ...);
  }
  void guarded(const std::function<void()>& write);

  std::shared_ptr<MonitorThread> thread_ = MonitorThread::ofThisProcess();
  ros::NodeHandle node_;
  std::set<std::string> topics_, unpublished_;
  std::mutex mutex_;  // of all below: messages come from the drive's thread and from the monitors'
  WholeBag bag_;
  std::size_t count_ = 0;
  std::string error_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace suspension_health_monitor
