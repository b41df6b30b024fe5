#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/reading_queue.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/signal/stream_resampler.h"

namespace suspension_health_monitor {

/// Samples of a strut at the instants of a uniform grid, every stream by a StreamResampler. They come
/// StreamResampler::kHalfWidth periods late, as soon as all streams reach so far ahead. After a pause that is too long
/// to be bridged the grid starts anew as soon as all windows are full, on the same multiples of T.
/// Cost per reading: O(1) amortised, no allocation.
class ResampledGrid {
 public:
  /// @param period  T > 0.
  ResampledGrid(Stamp period, bool has_road);

  /// @param waiting  from which the readings are taken that the sample needs.
  /// @return the next sample; nothing as long as the readings for it are not complete.
  std::optional<CornerSample> next(WaitingReadings& waiting);

  /// @return the road's acceleration at the sample given last [m/s^2].
  std::optional<double> roadAcceleration() const { return road_acceleration_; }

  /// Forgets all readings that have been taken in.
  void startNewSeries();

  const RejectCounts& rejected() const { return rejected_; }

  /// @return lost readings that were interpolated over, of all streams.
  std::uint64_t bridged() const;

 private:
  StreamResampler& stream(Side side) { return streams_[static_cast<std::size_t>(side)]; }
  bool begin(WaitingReadings& waiting);
  bool findRoad(Stamp t, WaitingReadings& waiting);

  Stamp period_;
  bool has_road_;
  std::array<StreamResampler, kMostStreams> streams_;
  std::optional<Stamp> origin_;  // of the series
  std::optional<Stamp> next_;
  bool road_is_silent_ = false;
  std::optional<double> road_acceleration_;
  RejectCounts rejected_;
};

}  // namespace suspension_health_monitor
