#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <cstdint>
#include <optional>
#include <string>

#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/signal/stream_clock.h"

namespace suspension_health_monitor {

inline constexpr const char* kImuType = "sensor_msgs/Imu";

/// The topics that anybody publishes, as the master told at most half a second ago: all silent sensors of a report,
/// which is due once a second, ask it once.
class PublishedTopics {
 public:
  /// @return empty if the master does not answer.
  const ros::master::V_TopicInfo& now();

 private:
  ros::WallTime asked_;
  ros::master::V_TopicInfo topics_;
};

/// What the task Input of /diagnostics is made of: each remembers what the last report has said, as a warning is about
/// what came since.

/// When the messages of one IMU came.
class ImuArrivals {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// @param timeout  [s] silence, by the clock and by the wall clock, that is an error.
  /// @param type  of its messages, as sensor_msgs/Imu: what else has such is named while nothing comes.
  ImuArrivals(const std::string& topic, double timeout, const std::string& type)
      : topic_(topic), timeout_(timeout), type_(type), begun_(ros::WallTime::now()) {}

  void note(const ros::Time& stamp);

  /// @param name  of the IMU.  @param max_lag  [s] mean time of arrival - stamp that is warned of.
  void describeLag(const std::string& name, const std::optional<double>& max_lag, Status& status) const;

  /// @return true if messages have come and no longer do.
  bool isSilentByWall() const;

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

/// The rate of one IMU as its stamps tell it.
/// @param name  of the IMU.  @param expected_rate  [Hz]; another one is warned of.
void describeTiming(const StreamClock& clock, const std::string& name, const std::optional<double>& expected_rate,
                    ImuArrivals::Status& status);

/// The series of samples that a monitor has taken in.
class SeriesHistory {
 public:
  void describe(const SuspensionMonitor& monitor, ImuArrivals::Status& status);

 private:
  std::uint64_t gaps_before_ = 0;
};

/// Readings that were kept out.
class RejectHistory {
 public:
  /// Adds the counts, as "OF rejected REASON".
  /// @return the reasons of those that came since the last call, with commas.
  std::string describe(const RejectCounts& rejected, const std::string& of, ImuArrivals::Status& status);

 private:
  RejectCounts before_;
};

/// The clock that stamps the data.
class ClockHistory {
 public:
  /// @return true if a simulated clock shows what it showed at the last describe().
  bool standsStill() const { return ros::Time::isSimTime() && before_ == ros::Time::now(); }

  void describe(ImuArrivals::Status& status);

 private:
  std::optional<ros::Time> before_;
};

}  // namespace suspension_health_monitor
