#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// How regularly the readings of one sensor come, by their stamps.
/// Cost per reading: O(1), no allocation.
class StreamTiming {
 public:
  static constexpr double kMemory = 0.999;  ///< forgetting factor

  /// Takes in the stamp of the next reading, later than the one before.
  void add(Stamp stamp) {
    const std::optional<Stamp> before = last_;
    last_ = stamp;
    if (!before) return;
    const double spacing = toSeconds(stamp - *before);
    const bool long_one = spacing_.weight() >= kSettled && spacing >= 1.5 * spacing_.mean();
    long_in_a_row_ = long_one ? long_in_a_row_ + 1 : 0;
    if (long_one && long_in_a_row_ < kNewRate) {
      const double periods = std::round(spacing / spacing_.mean());
      if (periods <= kLongestLoss) lost_ += static_cast<std::uint64_t>(periods) - 1;
      return;
    }
    if (long_one) spacing_ = square_ = RunningMean(kMemory);
    spacing_.add(spacing);
    const double deviation = spacing - spacing_.mean();
    square_.add(deviation * deviation);
  }

  /// Starts a new series: the next spacing does not count. What has been learned stays.
  void interrupt() { last_.reset(); }

  /// @return running mean of the spacing [s], pauses and lost readings left out; 0 before the second reading.
  double period() const { return spacing_.mean(); }

  /// @return standard deviation of the spacing [s], likewise.
  double jitter() const { return std::sqrt(square_.mean()); }

  /// @return readings that are missing in between, as far as single spacings of 2 to kLongestLoss periods tell.
  std::uint64_t lost() const { return lost_; }

 private:
  static constexpr double kLongestLoss = 50.0;  // [periods]; longer is a pause
  static constexpr double kSettled = 10.0;      // readings
  static constexpr int kNewRate = 10;           // so many long spacings in a row are no losses but the rate

  std::optional<Stamp> last_;
  RunningMean spacing_{kMemory};
  RunningMean square_{kMemory};  // of the spacing's deviation from its mean [s^2]
  int long_in_a_row_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace suspension_health_monitor
