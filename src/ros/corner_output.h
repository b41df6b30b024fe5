#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "message_pipeline.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"

namespace suspension_health_monitor {

/// The four corners of a vehicle against each other: the latched topic corners/comparison and a task of /diagnostics.
class CornerOutput {
 public:
  /// @param struts  the names of all struts.
  /// @return nothing unless the four corners are among them.
  static std::optional<CornerOutput> of(ros::NodeHandle& node, const std::vector<std::string>& struts);

  /// Judges the corners and publishes the newest verdict that two judgements in a row agreed on.
  /// @param pipeline  nullptr: none yet.
  void publish(const MessagePipeline* pipeline);

  /// The task "Corners".
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  using Places = std::array<std::size_t, kNumCorners>;

  CornerOutput(ros::NodeHandle& node, const Places& places);

  CornerComparisonReport judge(const MessagePipeline* pipeline);

  Places places_;  // of the corners among the struts
  ros::Publisher publisher_;
  Stamp newest_{};  // sample at the last judgement
  CornerComparisonReport last_ = compareCorners({}), confirmed_ = last_;
};

}  // namespace suspension_health_monitor
