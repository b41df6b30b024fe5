#include "suspension_health_monitor/internal/signal/period_measurement.h"

#include <algorithm>
#include <utility>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

std::optional<RejectReason> PeriodMeasurement::add(std::size_t stream, Stamp stamp) {
  Stream& its = streams_[stream];
  const std::optional<Stamp> before = std::exchange(its.last, stamp);
  if (before == stamp) return stamp == Stamp::zero() ? RejectReason::kZeroStamp : RejectReason::kRepeatedStamp;
  if (before && stamp < *before) return RejectReason::kTimeWentBack;
  if (is_required_[stream] && before) its.spacings.push_back(stamp - *before);
  return std::nullopt;
}

std::optional<double> PeriodMeasurement::period() const {
  for (std::size_t i = 0; i < streams_.size(); ++i)
    if (is_required_[i] && streams_[i].spacings.size() < spacings_wanted_) return std::nullopt;
  double slowest = 0.0;
  for (const Stream& stream : streams_) {
    if (stream.spacings.empty()) continue;  // not required
    const Stamp middle = median(stream.spacings);
    Stamp sum{};
    int count = 0;
    for (const Stamp spacing : stream.spacings) {
      if (2 * spacing <= middle || 2 * spacing >= 3 * middle) continue;
      sum += spacing;
      ++count;
    }
    slowest = std::max(slowest, toSeconds(sum) / count);
  }
  return slowest;
}

}  // namespace suspension_health_monitor
