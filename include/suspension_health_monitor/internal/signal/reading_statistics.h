#pragma once

#include <optional>

#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/range_end.h"
#include "suspension_health_monitor/internal/signal/stream_timing.h"

namespace suspension_health_monitor {

/// What the readings of one sensor are like, the newest thousand of them. Cost per reading: O(1), no allocation.
class ReadingStatistics {
 public:
  /// @param is_extreme  it equals the highest or the lowest reading so far, which a range may have cut off.
  void add(double reading, bool is_extreme);

  /// @param span  highest less lowest of all readings.
  UsualReadings usual(double span) const;

  /// @return how many of the last readings are of one value, without a break; as far as RangeEnd::kStuck.
  int equalInARow() const { return equal_in_a_row_; }

  double mean() const { return mean_.mean(); }
  double deviation() const { return deviation_.mean(); }  ///< mean distance from the mean

 private:
  std::optional<double> last_;
  int equal_in_a_row_ = 0;
  double finest_step_ = 0.0;                     // other than 0
  RunningMean repeated_{StreamTiming::kMemory};  // 1 for a reading that equals the one before, both extremes left out
  RunningMean mean_{StreamTiming::kMemory}, deviation_{StreamTiming::kMemory};
};

}  // namespace suspension_health_monitor
