#include "drive_recorder.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <sensor_msgs/Imu.h>
#include <suspension_health_monitor/CornerComparison.h>
#include <suspension_health_monitor/ModelComparison.h>
#include <suspension_health_monitor/ModelInUse.h>
#include <suspension_health_monitor/ParameterEstimate.h>
#include <suspension_health_monitor/SimulationTruth.h>
#include <suspension_health_monitor/SuspensionHealth.h>

#include <sstream>

#include "arrivals.h"

namespace suspension_health_monitor {

DriveRecorder::DriveRecorder(const ros::NodeHandle& node, const std::string& path, const std::string& topics)
    : node_(thread_->serve(node)), bag_(path) {
  std::istringstream names(topics);
  for (std::string name; names >> name;) topics_.insert(node.resolveName(name));
  unpublished_ = topics_;
}

// A subscriber of the very type that is published: within a process its messages are in the queue of the thread that
// serves it when publish() returns. One of any type (topic_tools::ShapeShifter) gets them later, from a thread of ROS.
template <class Message>
bool DriveRecorder::subscribe(const std::string& topic, const std::string& type) {
  if (type != ros::message_traits::DataType<Message>::value()) return false;
  constexpr std::uint32_t kUnlimited = 0;
  const auto take = [this, topic](const boost::shared_ptr<const Message>& message) {
    record(topic, message->header.stamp, *message);
  };
  subscribers_.push_back(node_.subscribe<Message>(topic, kUnlimited, take));
  return true;
}

std::vector<std::string> DriveRecorder::connect(const std::vector<std::string>& own) {
  for (const std::string& topic : own) unpublished_.erase(topic);
  for (const auto& [topic, type] : publishedTopics()) {
    if (unpublished_.count(topic) == 0) continue;
    if (!subscribeToOneOf<sensor_msgs::Imu, SimulationTruth, ParameterEstimate, ModelComparison, SuspensionHealth,
                          ModelInUse, CornerComparison, diagnostic_msgs::DiagnosticArray>(topic, type))
      throw std::invalid_argument("record_topics: " + topic + " has the type " + type +
                                  ", must be one of the types of this package, sensor_msgs/Imu or "
                                  "diagnostic_msgs/DiagnosticArray; `rosbag record` records the others");
    unpublished_.erase(topic);
  }
  return {unpublished_.begin(), unpublished_.end()};
}

void DriveRecorder::guarded(const std::function<void()>& write) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!error_.empty()) return;
  try {
    write();
  } catch (const std::runtime_error& error) {
    error_ = error.what();
  }
}

std::size_t DriveRecorder::commit() {
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();  // waits for a callback that runs
  if (count_ > 0) guarded([this] { bag_.commit(); });
  if (!error_.empty()) throw std::runtime_error(error_);
  return count_;
}

}  // namespace suspension_health_monitor
