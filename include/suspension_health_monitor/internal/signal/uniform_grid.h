#pragma once

#include <array>
#include <optional>
#include <string>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/paired_grid.h"
#include "suspension_health_monitor/internal/signal/reading_queue.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/signal/resampled_grid.h"
#include "suspension_health_monitor/internal/signal/stream_gate.h"

namespace suspension_health_monitor {

/// Brings the readings of the sensors onto one clock: pairs those whose stamps agree within half a sample (PairedGrid),
/// or resamples all streams (ResampledGrid). With Alignment::kAuto it pairs until the stamps show that this does badly
/// (AlignmentJudge), and resamples from then on. The result does not depend on the order in which the streams
/// interleave, as long as none runs more than kMostWaiting readings ahead, so that a replay gives what the live run
/// gave. Cost per reading: O(1) amortised, no allocation.
class UniformGrid {
 public:
  static constexpr std::size_t kMostWaiting = ReadingQueue::kCapacity;

  /// @param period  sampling time T > 0 [s].
  explicit UniformGrid(double period, const GridOptions& options = {});

  /// Takes in one reading of one sensor; each stream comes in the order in which it was measured.
  /// @param acceleration  along the strut, up positive [m/s^2].
  /// @return the first sample that this reading completes, stamped by the sprung sensor or, resampled, by the grid.
  /// It may complete several:
  ///     for (auto sample = grid.push(side, stamp, acceleration); sample; sample = grid.next())
  std::optional<CornerSample> push(Side side, Stamp stamp, double acceleration);

  /// @return the next sample that the readings so far complete.
  std::optional<CornerSample> next();

  /// @return the road's acceleration at the sample given last [m/s^2]; none without a reading near it.
  std::optional<double> roadAcceleration() const {
    return resamples_ ? resampled_.roadAcceleration() : paired_.roadAcceleration();
  }

  /// @return true if the samples are resampled; why() tells the reason in words, if it was found out.
  bool resamples() const { return resamples_; }
  std::string why() const;

  /// @return that readings of a strut's sensor come every 3/2 T or more, in words: samples are then missing though
  /// nothing gets lost, as sample_period is too short for this sensor. Empty if they come often enough.
  std::string whatIsTooSlow() const;

  /// @return "paired", "resampled", or "resampled because ...".
  std::string describeAlignment() const;

  /// @return lost readings that were interpolated over, of all sensors.
  std::uint64_t bridged() const { return resampled_.bridged(); }

  /// @return what was kept out, of all sensors.
  RejectCounts rejected() const;

  const StreamGate& gate(Side side) const { return gates_[static_cast<std::size_t>(side)]; }

 private:
  void startNewSeries(Side first);

  Stamp period_;
  bool resamples_;
  PairedGrid paired_;
  ResampledGrid resampled_;
  WaitingReadings waiting_;
  std::array<StreamGate, kMostStreams> gates_;
};

}  // namespace suspension_health_monitor
