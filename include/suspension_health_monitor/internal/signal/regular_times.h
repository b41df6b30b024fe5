#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/stream_timing.h"

namespace suspension_health_monitor {

/// When the readings of a stream were taken if they were taken regularly: the straight line through their stamps, least
/// squares of the newest kMemory readings, by the alpha-beta filter whose gains are theirs. A line through N stamps is
/// off by 2 / sqrt(N) of what a stamp is. It begins with kFewest readings, whose times are their stamps, and whose
/// median spacing tells how many periods they are apart.
///
/// Which period a reading belongs to is the likelier of a stamp that is off and of a reading that is lost, or was
/// counted as lost before: n periods more if it is off by more than n - 1/2 and ln(1 / p) times its variance, in
/// periods, where p is the share of readings that have got lost on this line.
/// Cost per reading: O(1), no allocation.
class RegularTimes {
 public:
  RegularTimes() : means_(StreamTiming::kMemory) {}

  /// Takes in the stamp of the next reading [s], later than the one before.
  /// @return the time by the line [s].
  double next(double stamp);

  /// A reading is left out.
  void passOver() { expected_ += 1.0; }

  /// The next reading belongs to another series.
  void interrupt() { readings_ = 0; }

  int inRow() const { return in_row_; }                     ///< readings, the newest included, of which none is missing
  double spacing() const { return spacing_; }               ///< by the line [s]
  double variance() const { return means_.mean(kSquare); }  ///< of stamps about the line [s^2]

  /// @return the share of readings that are not there, pauses left out [-].
  double missing() const { return std::max(0.0, means_.mean(kMissing)); }

  /// @return variance of next() [s^2], if stamps are off independently of each other: of the end of the line, and of
  /// readings that were taken for those of the next period, which shows in periods that have to be taken back.
  double varianceOfLine() const { return 4.0 / kMemory * variance() + means_.mean(kTakenBack) * spacing_ * spacing_; }

 private:
  static constexpr double kMemory = 1.0 / (1.0 - StreamTiming::kMemory);  // readings
  static constexpr int kFewest = 20;

  enum Mean : std::size_t { kSquare, kTakenBack, kMissing, kNumMeans };

  double begin(double stamp);
  void drawLine();
  double periodsTo(double stamp);

  double time_ = 0.0, spacing_ = 0.0;
  int readings_ = 0;                     // that the line rests on
  std::array<double, kFewest> first_{};  // their stamps
  double expected_ = 1.0;                // periods to the next reading, if none gets lost
  int in_row_ = 0, out_of_step_ = 0;
  RunningMeans<kNumMeans> means_;
  double losses_ = 0.0, followed_ = 0.0;  // times that readings got lost, less those taken back; readings
};

}  // namespace suspension_health_monitor
