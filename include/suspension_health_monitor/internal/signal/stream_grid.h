#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/signal/stream_gate.h"
#include "suspension_health_monitor/internal/signal/stream_resampler.h"

namespace suspension_health_monitor {

/// Brings the readings of any number of streams onto one clock. With Alignment::kAuto it pairs until the stamps show
/// that this does badly (AlignmentJudge), and resamples from then on.
/// - Paired, instants are where every required stream has a reading within half a sample of the reference's, as they
///   are, stamped by the reference: the first stream that is required. Whether a reading of the reference has a partner
///   in one stream does not depend on the others.
/// - Resampled, they are those of a uniform grid, every stream by a StreamResampler. They come
///   StreamResampler::kHalfWidth periods late, as soon as all streams reach so far ahead. After a pause that is too
///   long to be bridged the grid starts anew as soon as all windows are full, on the same multiples of T.
/// The result does not depend on the order in which the streams interleave, as long as none runs more than kMostWaiting
/// readings ahead, so that a replay gives what the live run gave. Cost per reading: O(1) amortised in time, O(streams),
/// no allocation.
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

  /// @return true if the streams are resampled, and why, if it was found out.
  bool resamples() const { return never_pairs_ || verdict() != AlignmentJudge::Verdict::kDoesWell; }
  AlignmentJudge::Verdict verdict() const { return judge_ ? judge_->verdict() : AlignmentJudge::Verdict::kDoesWell; }

  /// @return the longest period of a required stream [s]. From 3/2 T on instants are missing though nothing gets lost:
  /// sample_period is too short.
  double longestPeriod() const;
  double period() const { return toSeconds(period_); }  ///< T [s]
  Stamp settled() const;                                ///< the latest StreamClock::settled()

  const StreamGate& gate(std::size_t stream) const { return streams_[stream].gate; }

  /// @return what was kept out of one stream, and of all.
  RejectCounts rejected(std::size_t stream) const;
  RejectCounts rejected() const;

  /// @return readings of other streams and instants that were lost for want of a reading of this stream.
  std::uint64_t missed(std::size_t stream) const { return streams_[stream].missed; }

  /// @return lost readings that were interpolated over, of one stream, and of all.
  std::uint64_t bridged(std::size_t stream) const { return resamplers_[stream].bridged(); }
  std::uint64_t bridged() const;

 private:
  /// One stream, and what has become of its readings.
  struct Stream : StreamOptions {
    StreamGate gate;
    ReadingQueue waiting = ReadingQueue(kMostWaiting);
    RejectCounts rejected = {};  // of those that passed the gate
    std::uint64_t missed = 0;    // readings of others and instants that were lost for want of a reading of this stream
    bool is_silent = false;      // optional, and is not waited for until it comes again
    bool is_still = false;       // at the instant at hand

    /// Drops the oldest reading that waits: it has no partner.
    void drop() {
      rejected.add(RejectReason::kMissingPartner);
      waiting.pop_front();
    }
  };

  Stream& reference() { return streams_[reference_]; }
  void dropOldest(Stream& full);
  void startNewSeries(std::size_t first);
  bool areWaiting() const;
  bool mayStillCome(Stream& optional) const;
  bool rejectStuck();

  bool pairNext();
  bool dropTooOld();
  bool dropLoneReference();
  bool optionalOnesAreReady();
  void takePaired();

  bool resampleNext();
  bool beginSeries();
  StreamResampler::Coverage advance(Stamp t);
  void takeResampled(Stamp t);

  Stamp period_;
  bool never_pairs_;
  std::size_t reference_;
  std::vector<Stream> streams_;
  std::vector<bool> sensor_is_still_;
  std::optional<AlignmentJudge> judge_;      // of kAuto; none: pairing goes on however badly it does
  std::vector<StreamResampler> resamplers_;  // by stream
  std::optional<Stamp> origin_, next_;       // of the resampled series, its next instant
  GridInstant instant_;
};

}  // namespace suspension_health_monitor
