#pragma once

#include <ros/ros.h>

#include <map>
#include <optional>
#include <string>

#include "suspension_health_monitor/internal/math/running_means.h"
#include "task_log.h"

namespace suspension_health_monitor {

/// Asks the master.
/// @return the type of every topic that some node publishes, by the topic's name; empty if the master does not answer.
std::map<std::string, std::string> publishedTopics();

/// publishedTopics() of at most half a second ago: all silent sensors of a report, which is due once a second, ask the
/// master once.
class PublishedTopics {
 public:
  const std::map<std::string, std::string>& now();

 private:
  ros::WallTime asked_;
  std::map<std::string, std::string> topics_;
};

/// When the messages of one sensor came.
class Arrivals {
 public:
  /// @param timeout  [s] silence, by the clock and by the wall clock, that is an error.
  /// @param type  of its messages, as sensor_msgs/Imu: while nothing comes, other topics of this type are named.
  Arrivals(const std::string& topic, double timeout, const std::string& type)
      : topic_(topic), timeout_(timeout), type_(type), begun_(ros::WallTime::now()) {}

  void note(const ros::Time& stamp);

  /// @param name  of the sensor.  @param max_lag  [s] mean time of arrival - stamp that is warned of.
  void describeLag(const std::string& name, const std::optional<double>& max_lag, Status& status) const;

  /// @return true if messages have come and no longer do.
  bool isSilentByWall() const { return last_ && (ros::WallTime::now() - last_->by_wall).toSec() > timeout_; }

  void describeSilence(PublishedTopics& published, Status& status) const;

 private:
  struct Last {
    ros::Time by_clock;
    ros::WallTime by_wall;
    RunningMean lag{0.99};
  };

  std::string whatElseThereIs(PublishedTopics& published) const;

  std::string topic_;
  double timeout_;
  std::string type_;
  ros::WallTime begun_;
  std::optional<Last> last_;
};

}  // namespace suspension_health_monitor
