#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/grid_streams.h"
#include "suspension_health_monitor/internal/signal/grids.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {

/// Brings the readings of any number of streams onto one clock: pairs those whose stamps agree within half a sample
/// (PairedGrid), or resamples all streams (ResampledGrid). With Alignment::kAuto it pairs until the stamps show that
/// this does badly (AlignmentJudge), and resamples from then on. The result does not depend on the order in which the
/// streams interleave, as long as none runs more than kMostWaiting readings ahead, so that a replay gives what the live
/// run gave. Cost per reading: O(1) amortised in time, O(streams), no allocation.
class StreamGrid {
 public:
  /// @param period  sampling time T > 0 [s].
  /// @param streams  the first one that is required stamps the instants of paired readings.
  /// @param fill_samples  that the user needs in a row before they are of use; Alignment::kAuto judges by it.
  /// @throws std::invalid_argument  on a period that is none, or if no stream is required.
  StreamGrid(double period, const std::vector<StreamOptions>& streams, Alignment alignment, int fill_samples);

  /// Takes in one reading of one stream; each stream comes in the order in which it was measured.
  /// @param stream  its place among those given at construction.
  /// @return the first instant that this reading completes, valid until the next call; nullptr if there is none.
  /// It may complete several:
  ///     for (auto instant = grid.push(stream, stamp, value); instant; instant = grid.next())
  const GridInstant* push(std::size_t stream, Stamp stamp, double value);

  /// @return the next instant that the readings so far complete, likewise.
  const GridInstant* next();

  /// @return when the newest reading was taken (StreamClock); empty if it was kept out.
  const std::optional<Stamp>& taken() const { return taken_; }

  /// @return true if the streams are resampled, and why, if it was found out.
  bool resamples() const { return resamples_; }
  AlignmentJudge::Verdict verdict() const { return paired_.verdict(); }

  /// @return the longest period of a required stream [s]. From 3/2 T on instants are missing though nothing gets lost:
  /// sample_period is too short.
  double longestPeriod() const;
  double period() const { return toSeconds(period_); }  ///< T [s]

  const StreamGate& gate(std::size_t stream) const { return streams_[stream].gate; }

  /// @return what was kept out of one stream, and of all.
  RejectCounts rejected(std::size_t stream) const;
  RejectCounts rejected() const;

  /// @return readings of other streams and instants that were lost for want of a reading of this stream.
  std::uint64_t missed(std::size_t stream) const { return streams_[stream].missed; }

  /// @return lost readings that were interpolated over, of one stream, and of all.
  std::uint64_t bridged(std::size_t stream) const { return resampled_.bridged(stream); }
  std::uint64_t bridged() const;

 private:
  void dropOldest(GridStream& full);
  void startNewSeries(std::size_t first);

  Stamp period_;
  bool resamples_;
  GridStreams streams_;
  PairedGrid paired_;
  ResampledGrid resampled_;
  GridInstant instant_;
  std::optional<Stamp> taken_;
};

}  // namespace suspension_health_monitor
