#pragma once

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Whether LS and LA say the same (agree()). If they do not for long, there are outliers, or was a step. Cost per
/// update: O(1), no allocation.
class Agreement {
 public:
  void update(const StrutEstimate& ls, const StrutEstimate& la);

  /// @return true if they have not for much of the last kMemory updates.
  bool fails() const { return failing_ > kOften; }

 private:
  static constexpr double kOften = 0.4, kMemory = 50.0;  // updates: ten memories of LS and LA

  double failing_ = 0.0;  // share of the updates
};

}  // namespace suspension_health_monitor
