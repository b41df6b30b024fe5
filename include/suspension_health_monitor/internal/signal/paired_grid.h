#pragma once

#include <optional>

#include "suspension_health_monitor/internal/signal/alignment_judge.h"
#include "suspension_health_monitor/internal/signal/grid_streams.h"

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

}  // namespace suspension_health_monitor
