#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "live_search.h"
#include "monitor_thread.h"

namespace suspension_health_monitor {

/// What curves are fitted to.
struct CurveTask {
  SearchTask search;                              ///< its samples, names and sample period
  std::vector<std::optional<StrutModel>> models;  ///< by strut, to start with; nothing: not known
  std::vector<std::string> frames;                ///< by strut, of its body's IMU
};

/// ~damper_curve and ~spring_curve of every strut, latched: fitted to the newest samples beside the nodelet, as
/// ~diagnose searches them, once in kEvery of drive and while somebody listens. A curve that the samples do not tell
/// leaves the one before in place.
class LiveCurves {
 public:
  /// A time of drive between two fits.
  static constexpr Stamp kEvery = std::chrono::seconds(60);

  /// Most samples of a fit: its time and memory do not grow with the rate.
  static constexpr double kMostSamples = 20000.0;

  /// Called in the nodelet's thread.
  /// @param last  stamp of the newest sample of the last fit.
  /// @return nothing: no fit is due, or no strut is known.
  using Prepare = std::function<std::optional<CurveTask>(Stamp last)>;

  /// @param struts  where the topics of each are.  @param nodelet_thread  that serves the nodelet; outlives this
  /// object.
  LiveCurves(const std::vector<ros::NodeHandle>& struts, MonitorThread& nodelet_thread, Prepare prepare);

  /// Waits for a fit that runs.
  ~LiveCurves();
  LiveCurves(const LiveCurves&) = delete;
  LiveCurves& operator=(const LiveCurves&) = delete;

 private:
  struct Topics {
    ros::Publisher damper, spring;
    bool isHeard() const { return damper.getNumSubscribers() + spring.getNumSubscribers() > 0; }
  };

  void updateIfDue();
  void update(const CurveTask& task);

  MonitorThread& nodelet_thread_;
  Prepare prepare_;
  std::vector<Topics> topics_;  // by strut
  Stamp last_ = -kEvery;        // the first fit is due at once
  ros::CallbackQueue queue_;
  ros::WallTimer timer_;
  ros::AsyncSpinner spinner_;
};

}  // namespace suspension_health_monitor
