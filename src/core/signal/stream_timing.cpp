#include "suspension_health_monitor/internal/signal/stream_timing.h"

namespace suspension_health_monitor {

void StreamTiming::add(Stamp stamp) {
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

}  // namespace suspension_health_monitor
