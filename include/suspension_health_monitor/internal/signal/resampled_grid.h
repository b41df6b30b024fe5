#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/signal/grid_streams.h"
#include "suspension_health_monitor/internal/signal/stream_resampler.h"

namespace suspension_health_monitor {

/// The instants of a uniform grid, every stream by a StreamResampler. They come StreamResampler::kHalfWidth periods
/// late, as soon as all streams reach so far ahead. After a pause that is too long to be bridged the grid starts anew
/// as soon as all windows are full, on the same multiples of T. Cost per reading: O(1) amortised, no allocation.
class ResampledGrid {
 public:
  /// @param period  T > 0.
  ResampledGrid(Stamp period, std::size_t streams) : period_(period), resamplers_(streams, StreamResampler(period)) {}

  /// @param streams  from which the readings are taken that the instant needs.
  /// @return true if the next instant is found; not as long as the readings for it are incomplete.
  bool next(GridStreams& streams, GridInstant& instant);

  /// Forgets all readings that have been taken in.
  void startNewSeries();

  /// @return lost readings of the stream that were interpolated over.
  std::uint64_t bridged(std::size_t stream) const { return resamplers_[stream].bridged(); }

 private:
  bool begin(const GridStreams& streams);
  StreamResampler::Coverage advanceRequired(Stamp t, GridStreams& streams);
  bool takeOptional(Stamp t, GridStreams& streams, GridInstant& instant);
  void takeRequired(Stamp t, GridStreams& streams, GridInstant& instant);

  Stamp period_;
  std::vector<StreamResampler> resamplers_;  // by stream
  std::optional<Stamp> origin_;              // of the series
  std::optional<Stamp> next_;
};

}  // namespace suspension_health_monitor
