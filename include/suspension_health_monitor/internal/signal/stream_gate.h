#pragma once

#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/signal/range_end.h"
#include "suspension_health_monitor/internal/signal/reading_statistics.h"
#include "suspension_health_monitor/internal/signal/reject_reason.h"
#include "suspension_health_monitor/internal/signal/stream_timing.h"
#include "suspension_health_monitor/internal/signal/usual_size.h"

namespace suspension_health_monitor {

/// Lets the readings of one sensor pass that can be true, by their stamps and values, and counts the others by reason.
///
/// Clipping is recognised without knowing the sensor's range: flat tops at the very highest or lowest value that the
/// sensor has ever read, of a sensor that resolves far finer (RangeEnd). From then on every reading at that value is
/// kept out, until a reading beyond it shows that it was no limit.
/// Absurd is what no vehicle survives, more than kMostOfAVehicle, unless the sensor reads like that: a hundred times
/// its usual size passes, for sensors that read in another unit. So nothing behind the gate meets a reading of 1e20.
/// A force may have any usual size, rest and stay at an end of its range: it is absurd above kMostInAnyUnit alone.
/// Cost per reading: O(1), no allocation.
class StreamGate {
 public:
  /// @param period  sampling time T; a reading that is more than 50 T older than its predecessor is a clock that jumped
  ///                or a bag that loops, not a message that was overtaken.
  /// @param is_force  not an acceleration.
  explicit StreamGate(Stamp period, bool is_force = false)
      : longest_overtaking_(50 * period), is_force_(is_force), usual_size_(toSeconds(period)) {}

  enum class Verdict {
    kPasses,
    kRejected,
    kBeginsAnew,  ///< passes, but the clock went back: what came before belongs to another series
  };

  /// Looks at the next reading. A reading that is rejected for its stamp leaves no trace but in the counters.
  Verdict judge(Stamp stamp, double acceleration);

  /// Forgets the last stamp: the next reading may have any.
  void startNewSeries();

  /// @return true if the last RangeEnd::kStuck readings were all the same: a sensor that is stuck, or a vehicle at rest
  /// and a sensor that resolves coarsely. Which of the two, the strut's other sensor tells.
  bool isStill() const { return statistics_.equalInARow() == RangeEnd::kStuck; }

  /// @return the mean distance of the newest thousand readings from their mean [m/s^2].
  double deviation() const { return statistics_.deviation(); }

  /// @return how far from that mean any reading has been [m/s^2], those that were kept out as absurd left out.
  double farthest() const;

  const RejectCounts& rejected() const { return rejected_; }
  const StreamTiming& timing() const { return timing_; }

 private:
  static constexpr int kBelievedAgain = 10;  // readings: what stands between absurd ones is as wrong as they are

  std::optional<RejectReason> faultOfStamp(Stamp stamp) const;
  bool isAbsurd(double acceleration);
  bool isClipped(double acceleration);
  Verdict reject(RejectReason reason);

  Stamp longest_overtaking_;
  bool is_force_;
  std::optional<Stamp> last_;
  int believed_ = kBelievedAgain;      // readings in a row that are not absurd, up to kBelievedAgain
  UsualSize usual_size_;               // |acceleration|, of all that are numbers
  ReadingStatistics statistics_;       // of all readings that passed, the clipped ones included
  RangeEnd upper_{1.0}, lower_{-1.0};  // likewise
  RejectCounts rejected_;
  StreamTiming timing_;
};

}  // namespace suspension_health_monitor
