#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <suspension_health_monitor/ParameterEstimate.h>
#include <suspension_health_monitor/SuspensionHealth.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "corners_options.h"
#include "monitor_thread.h"

namespace suspension_health_monitor {

/// Compares the struts of four monitors named front_left, front_right, rear_left, rear_right in its namespace.
/// Its callbacks run in the thread of the monitors of the process.
class CornersNodelet : public nodelet::Nodelet {
 public:
  ~CornersNodelet() override;

 private:
  /// A verdict that may take the place of the one that is reported.
  struct Pending {
    CornerComparisonReport verdict;
    ros::WallTime since;
  };

  struct Corner {
    ParameterEstimateConstPtr estimate;
    SuspensionHealthConstPtr health;
    ros::WallTime last;
  };

  /// @throws std::invalid_argument  on a wrong parameter, after logging it: the loader drops the nodelet and lives on.
  void onInit() override;

  void subscribe();
  void onTick();
  bool confirm(const CornerComparisonReport& now, ros::WallTime time);
  std::array<CornerState, kNumCorners> states() const;
  void publishComparison();
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  std::shared_ptr<MonitorThread> thread_ = MonitorThread::ofThisProcess();
  CornersOptions options_;
  ros::NodeHandle node_, private_node_;
  std::array<Corner, kNumCorners> corners_;
  CornerComparisonReport report_;
  Pending pending_;
  ros::WallTime published_;
  std::optional<diagnostic_updater::Updater> updater_;
  ros::Publisher comparison_;
  ros::WallTimer tick_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace suspension_health_monitor
