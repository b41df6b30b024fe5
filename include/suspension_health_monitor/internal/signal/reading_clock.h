#pragma once

#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/regular_times.h"
#include "suspension_health_monitor/internal/signal/sliding_window.h"

namespace suspension_health_monitor {

/// When the readings of one stream were taken. Where stamps are irregular, either the readings were taken so, or they
/// were taken regularly and stamped when they happened to arrive, or something of both: of the variance of the distance
/// d_k of a stamp from the regular time (RegularTimes) a share b is true. More than half: they were taken as stamped.
///
/// The readings tell b. With x(t) the signal, a reading is x_k = x(regular) + b x' d_k. Fourth differences D take the
/// signal out of that as far as it is slow, so that b is the slope of e = D x_k over r = D (x'_k d_k), by least squares
/// of all readings, of which rough driving counts most: there it matters. x' is that of readings taken regularly; where
/// they are not it is noisy, and b too small by a tenth or two. The scatter of blocks of readings says how
/// certain b is, since neighbouring differences share readings. Beforehand stamps are taken at their
/// word, b = 1. Cost per reading: O(1), no allocation.
class ReadingClock {
 public:
  ReadingClock();

  /// Takes in the next reading, whose stamp is later than that of the one before.
  /// @return when it was taken, likewise later.
  Stamp take(Stamp stamp, double value);

  /// A reading is kept out. Unless it repeats the last one's stamp, it was taken, too.
  void passOver(Stamp stamp);

  /// The next stamp may be any: another series.
  void interrupt();

  /// @return b in [0, 1]: of what the stamps are irregular by that the readings are, too [-].
  double share() const { return share_; }

 private:
 private:
  static constexpr int kReach = 3;  // of a derivative, to either side
  static constexpr int kHalf = 2;   // of a fourth difference
  static constexpr int kWindow = 2 * (kReach + kHalf) + 1;

  /// Products of r and e: sums over a block, or over all blocks.
  struct Products {
    double rr = 0.0, re = 0.0;
  };

  bool followsStamps() const { return share_ > 0.5; }
  void compare();
  void closeBlock();
  double rateAt(int i) const;

  std::optional<Stamp> origin_, last_stamp_, last_;
  RegularTimes regular_;
  SlidingWindow<kWindow> values_, off_;  // readings, and d [s]
  RunningMean size_;                     // of |e|
  Products block_, all_;
  int rows_ = 0;                        // of the block
  double scores_ = 0.0, blocks_ = 0.0;  // sum of squares of blocks' scores; blocks
  double share_ = 1.0;
};

}  // namespace suspension_health_monitor
