#pragma once

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Whether LS and LA say the same. If they are more than kMostApart standard deviations of LA apart, or LS is more than
/// kTails times as uncertain as far as the scatter of both is known, there are outliers, or was a step. Cost per
/// update: O(1), no allocation.
class Agreement {
 public:
  /// @param memory  of the estimates, in updates.
  void update(const StrutEstimate& ls, const StrutEstimate& la, double memory);

  /// @return true if they said the same at the last update.
  bool holds() const { return holds_; }

  /// @return true if they have not for much of the last ten memories.
  bool fails() const { return failing_ > kOften; }

 private:
  static constexpr double kMostApart = 3.0, kTails = 2.5;
  static constexpr double kOften = 0.4, kMemories = 10.0;

  bool holds_ = false;
  double failing_ = 0.0;  // share of the updates
};

}  // namespace suspension_health_monitor
