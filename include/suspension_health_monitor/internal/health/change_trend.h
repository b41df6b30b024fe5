#pragma once

#include <array>
#include <cstddef>

#include "suspension_health_monitor/internal/health/strut_change.h"

namespace suspension_health_monitor {

/// Takes the lag of an estimate away where the strut changes steadily: an estimate is about the strut of `age` ago.
///
/// A straight line by weighted least squares through the newest changes, each at the time of its data. Estimates whose
/// windows overlap share their errors, so that each counts only by the part of its window that is new. Where the slope
/// is significant the newest change is carried on by it, by no more than kMostCarried, so that a small step does not
/// look large. Cost per change: O(kChanges), no allocation.
class ChangeTrend {
 public:
  /// @param change  the newest one.  @param age  of its data [s].
  /// @param now  a time that increases [s].  @param window  span of the data [s].
  /// @param certain  standard deviations that a slope must have to be one.
  /// @return the change as it is now.
  LogChange carryOn(const LogChange& change, double age, double now, double window, double certain);

  void restart() { count_ = 0; }

 private:
  static constexpr std::size_t kChanges = 16;  // over four windows that share no reading
  static constexpr double kMostCarried = 0.03;

  struct Point {
    double time, size, weight;
  };

  std::array<Point, kChanges> points_{};
  std::size_t count_ = 0;
  double last_ = 0.0;
};

}  // namespace suspension_health_monitor
