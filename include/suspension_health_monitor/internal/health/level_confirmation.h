#pragma once

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Lets a level pass once it has lasted for the confirm time. While levels alternate that are all worse (or all better)
/// than the confirmed one, the one nearest to it counts as lasting, so that noise at a threshold hides nothing.
/// Cost per level: O(1), no allocation.
class LevelConfirmation {
 public:
  explicit LevelConfirmation(Stamp confirm_time) : confirm_time_(confirm_time) {}

  void setConfirmTime(Stamp confirm_time) { confirm_time_ = confirm_time; }

  /// @param stamp  stamps that go back restart the confirmation.
  /// @return the confirmed level.
  HealthLevel update(Stamp stamp, HealthLevel now);

 private:
  Stamp confirm_time_;
  HealthLevel confirmed_ = HealthLevel::kStale;
  HealthLevel pending_ = HealthLevel::kStale;
  Stamp pending_since_{};
};

}  // namespace suspension_health_monitor
