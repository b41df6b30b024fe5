#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/signal/alignment.h"
#include "suspension_health_monitor/signal/alignment_judge.h"
#include "suspension_health_monitor/signal/reject_reason.h"
#include "suspension_health_monitor/signal/resampled_grid.h"
#include "suspension_health_monitor/signal/stream_gate.h"

namespace suspension_health_monitor {

/// Brings the readings of the sensors onto one clock: pairs those whose stamps agree within half a sample, or resamples
/// all streams (ResampledGrid). With Alignment::kAuto it pairs until the stamps show that this does badly
/// (AlignmentJudge), and resamples from then on. The result does not depend on the order in which the streams
/// interleave, as long as none runs more than kMostWaiting readings ahead, so that a replay gives what the live run
/// gave. A road sensor, if there is one, is waited for, but no longer than kMostRoadLag readings of the others: a strut
/// does not need it. Cost per reading: O(1) amortised, no allocation.
class UniformGrid {
 public:
  static constexpr std::size_t kMostWaiting = 4096;
  static constexpr std::size_t kMostRoadLag = 64;

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
    return resamples_ ? resampled_->roadAcceleration() : road_acceleration_;
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
  std::uint64_t bridged() const { return resampled_ ? resampled_->bridged() : 0; }

  /// @return what was kept out, of all sensors.
  RejectCounts rejected() const;

  const StreamGate& gate(Side side) const { return gates_[static_cast<std::size_t>(side)]; }

 private:
  struct Reading {
    Stamp stamp;
    double acceleration;
    bool still;  // StreamGate::isStill()
  };

  /// First in, first out, of fixed capacity.
  class Queue {
   public:
    Queue() : readings_(kMostWaiting) {}
    bool empty() const { return size_ == 0; }
    bool full() const { return size_ == kMostWaiting; }
    const Reading& front() const { return readings_[first_]; }
    void push(const Reading& reading) { readings_[(first_ + size_++) % kMostWaiting] = reading; }
    void pop() {
      first_ = (first_ + 1) % kMostWaiting;
      --size_;
    }
    std::size_t size() const { return size_; }

   private:
    std::vector<Reading> readings_;
    std::size_t first_ = 0;
    std::size_t size_ = 0;
  };

  bool admit(Side side, Stamp stamp, double acceleration);
  std::optional<CornerSample> match();
  bool findRoad(Stamp stamp);
  void drop(Queue& queue);
  void resample(Side side, const Reading& reading);
  void startResampling();
  void startNewSeries(std::size_t first);

  Stamp period_;
  GridOptions options_;
  AlignmentJudge judge_;
  std::optional<ResampledGrid> resampled_;  // unless it shall only pair
  bool resamples_;
  std::array<Queue, kMostStreams> waiting_;
  std::array<StreamGate, kMostStreams> gates_;
  bool road_is_silent_ = false;
  std::optional<double> road_acceleration_;
  RejectCounts rejected_;  // by the pairing
};

}  // namespace suspension_health_monitor
