#pragma once

#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/signal/alignment.h"
#include "suspension_health_monitor/internal/signal/alignment_judge.h"
#include "suspension_health_monitor/internal/signal/reading_queue.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"

namespace suspension_health_monitor {

/// Samples of a strut from readings whose stamps agree within half a sample, as they are, stamped by the body's sensor.
/// Cost per reading: O(1), no allocation.
class PairedGrid {
 public:
  /// @param period  T > 0.
  PairedGrid(Stamp period, const GridOptions& options)
      : period_(period), options_(options), judge_(period, options.fill_samples) {}

  /// @param waiting  from which readings are taken: those of the sample, and those that will find no partner.
  /// @return the next sample; nothing as long as its readings are not complete, or if pairing does badly.
  std::optional<CornerSample> next(WaitingReadings& waiting);

  /// @return the road's acceleration at the sample given last [m/s^2]; none without a reading near it.
  std::optional<double> roadAcceleration() const { return road_acceleration_; }

  /// @return how well the pairing does, which only Alignment::kAuto asks.
  AlignmentJudge::Verdict verdict() const { return judge_.verdict(); }

  /// Drops a reading that has no partner.
  void drop(ReadingQueue& queue);

  /// The clock went back.
  void startNewSeries(WaitingReadings& waiting);

  const RejectCounts& rejected() const { return rejected_; }

 private:
  bool findRoad(Stamp stamp, WaitingReadings& waiting);

  Stamp period_;
  GridOptions options_;
  AlignmentJudge judge_;
  bool road_is_silent_ = false;
  std::optional<double> road_acceleration_;
  RejectCounts rejected_;
};

}  // namespace suspension_health_monitor
