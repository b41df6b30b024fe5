#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/grid_streams.h"
#include "suspension_health_monitor/internal/signal/stream_resampler.h"

namespace suspension_health_monitor {

/// Instants at which every required stream has a reading within half a sample of the reference's, as they are, stamped
/// by the reference. Whether a reading of the reference has a partner in one stream does not depend on the others.
/// Cost per reading: O(1), no allocation.
class PairedGrid {
 public:
  /// @param period  T > 0.
  /// @param judge  of how well the pairing does; none: it goes on however badly it does.
  PairedGrid(Stamp period, const std::optional<AlignmentJudge>& judge) : period_(period), judge_(judge) {}

  /// @param streams  from which readings are taken: those of the instant, and those that will find no partner.
  /// @return true if the next instant is found; not as long as its readings are incomplete, or if pairing does badly.
  bool next(GridStreams& streams, GridInstant& instant);

  AlignmentJudge::Verdict verdict() const { return judge_ ? judge_->verdict() : AlignmentJudge::Verdict::kDoesWell; }

  /// The clock went back.
  void startNewSeries(GridStreams& streams);

 private:
  bool dropTooOld(GridStreams& streams);
  bool dropLoneReference(GridStreams& streams);
  bool optionalOnesAreReady(GridStreams& streams) const;
  void take(GridStreams& streams, GridInstant& instant);

  Stamp period_;
  std::optional<AlignmentJudge> judge_;
};

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
