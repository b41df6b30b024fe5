#pragma once

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Whether the residuals of LS have had heavy tails for long: there are outliers. Cost per update: O(1), no allocation.
class Outliers {
 public:
  void update(const StrutEstimate& ls) { present_ += ((ls.tails > kHeavy ? 1.0 : 0.0) - present_) / kMemory; }

  /// @return true if there have been for much of the last kMemory updates.
  bool arePresent() const { return present_ > kOften; }

 private:
  static constexpr double kHeavy = 4.0;                  // StrutEstimate::tails: 2 as Laplace's, twice that
  static constexpr double kOften = 0.4, kMemory = 50.0;  // updates: ten memories of LS

  double present_ = 0.0;  // share of the updates
};

}  // namespace suspension_health_monitor
