#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "monitor_host.h"

namespace suspension_health_monitor {

/// ~damper_curve and ~spring_curve of every strut, latched: fitted to the newest samples beside the nodelet, as
/// ~diagnose searches them, once in kEvery of drive and while somebody listens. A curve that the samples do not tell
/// leaves the one before in place.
class LiveCurves {
 public:
  /// @param host  outlives this object.  @param struts  where the topics of each are.
  /// @param diagnose_window  [s] of samples that are kept.
  LiveCurves(MonitorHost& host, const std::vector<ros::NodeHandle>& struts, double diagnose_window);
  LiveCurves(const LiveCurves&) = delete;
  LiveCurves& operator=(const LiveCurves&) = delete;

 private:
  /// A time of drive between two fits.
  static constexpr Stamp kEvery = std::chrono::seconds(60);

  struct Task {
    SearchTask search;                              // its samples, names and sample period
    std::vector<std::optional<StrutModel>> models;  // by strut, to start with; nothing: not known
    std::vector<std::string> frames;                // by strut, of its body's IMU
  };
  struct Topics {
    ros::Publisher damper, spring;
    bool isHeard() const { return damper.getNumSubscribers() + spring.getNumSubscribers() > 0; }
  };

  void updateIfDue();
  std::optional<Task> taskIfDue() const;
  void update(const Task& task);

  MonitorHost& host_;
  MonitorThread& thread_;
  double diagnose_window_;      // [s]
  std::vector<Topics> topics_;  // by strut
  Stamp last_ = -kEvery;        // newest sample of the last fit; the first one is due at once
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  ros::WallTimer timer_;  // last, and so gone first: its end waits for a fit that runs
};

}  // namespace suspension_health_monitor
