#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/math/running_means.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/signal/stream_clock.h"
#include "suspension_health_monitor/internal/signal/tuning.h"

namespace suspension_health_monitor {

/// What the readings of one sensor are like, the newest thousand of them. Cost per reading: O(1), no allocation.
struct ReadingStatistics {
  std::optional<double> last;  ///< reading
  int equal_in_a_row = 0;      ///< of one value, without a break, up to the last one; counts up to kSignalTuning.stuck
  double finest_step = 0.0;    ///< smallest step other than 0 from one reading to the next
  RunningMean average{StreamClock::kMemory};
  RunningMean distance{StreamClock::kMemory};  ///< from the average
  RunningMean repeated{StreamClock::kMemory};  ///< 1: a reading equals the one before; both extremes are left out

  /// @param is_extreme  it equals the highest or the lowest reading so far, which a range may have cut off.
  void add(double reading, bool is_extreme);

  /// @return true if they are enough to tell mean and spread.
  bool areEnough() const { return std::min(average.weight(), repeated.weight()) >= kSignalTuning.fewest_for_means; }
};

/// The upper or the lower end of what one sensor has read: do its readings stop there because its range does?
///
/// Signs of a range that ends (numbers: SignalTuning): flat tops, three equal readings in a row or more, at the very
/// extreme; and more readings at the extreme than within a narrow band below it. Of a signal that turns by itself the
/// band holds more, however coarsely it is quantised: a parabola stays in the n steps of resolution below its top
/// sqrt(1 + n) - 1 times as long as in the top one. Far from the mean one flat top is enough; near it, where heavy
/// clipping has its limit, five are, since a sensor may be stuck anywhere. One flat top that lasts is no limit but a
/// sensor that is stuck. A sensor that repeats its readings must show tops that are longer than its usual repetitions.
/// Cost per reading: O(1), no allocation.
class RangeEnd {
 public:
  /// @param sign  1: the upper end, -1: the lower one.
  explicit RangeEnd(double sign) : sign_(sign) {}

  /// Takes in the next reading.
  /// @param all  the readings so far, this one included.  @param span  highest less lowest of those before it.
  void add(double reading, const ReadingStatistics& all, double span);

  /// @return the farthest reading so far; none before the first one.
  const std::optional<double>& extreme() const { return extreme_; }

  /// @return where the range ends, as long as no reading goes beyond.
  const std::optional<double>& limit() const { return limit_; }

 private:
  void count(double reading, double band);
  void countFlatTops(double reading, const ReadingStatistics& all);

  double sign_;
  std::optional<double> extreme_, limit_;
  double at_ = 0.0, near_ = 0.0;  // readings at the extreme; within the band below
  int flat_tops_ = 0;             // counts up to kSignalTuning.flat_tops
  bool in_flat_top_ = false;
};

/// Running median of the size of a sensor's readings.
///
/// It is followed on a logarithmic scale by steps of one size, up for a reading above it and down for one below, so
/// that 1e300 moves it as little as the next larger reading. Readings that are wrong for a while move it by what half
/// of the readings of that time would; if they stay so, as where a sensor reads in another unit from now on, the
/// median becomes theirs.
/// Cost per reading: O(1), no allocation.
class RunningMedian {
 public:
  /// @param period  from one reading to the next, above 0 [s].
  explicit RunningMedian(double period) : slowest_step_(period / kSignalTuning.fold_time) {}

  /// @param size  of the next reading, finite and not negative.
  void add(double size) {
    readings_ = std::min(readings_ + 1.0, kSignalTuning.first_step / slowest_step_);
    if (median_ == 0.0) median_ = size;
    const double factor = std::exp(kSignalTuning.first_step / readings_);
    median_ = std::clamp(size > median_ ? median_ * factor : median_ / factor, kSmallest, kLargest);
  }

  /// @return the median; none as long as there are fewer than kSignalTuning.fewest_for_size readings.
  double median() const { return readings_ >= kSignalTuning.fewest_for_size ? median_ : 0.0; }

 private:
  static constexpr double kSmallest = 1e-100, kLargest = 1e100;  // its logarithm stays a number

  double slowest_step_;
  double readings_ = 0.0;
  double median_ = 0.0;
};

/// Lets the readings of one sensor pass that can be true, by their stamps and values, and counts the others by reason.
///
/// Clipping is recognised without knowing the sensor's range: flat tops at the very highest or lowest value that the
/// sensor has ever read, of a sensor that resolves far finer (RangeEnd). From then on every reading at that value is
/// kept out, until a reading beyond it shows that it was no limit.
/// Absurd is what no vehicle survives, more than kMostOfAVehicle, unless the sensor reads like that: a hundred times
/// its median size passes, for sensors that read in another unit. So nothing behind the gate meets a reading of 1e20.
/// A force may have any median size, rest and stay at an end of its range: it is absurd above kMostInAnyUnit alone.
/// Cost per reading: O(1), no allocation.
class StreamGate {
 public:
  /// @param period  sampling time T; a reading that is more than 50 T older than its predecessor is a clock that jumped
  ///                or a bag that loops, not a message that was overtaken.
  /// @param is_force  not an acceleration.
  explicit StreamGate(Stamp period, bool is_force = false)
      : longest_overtaking_(50 * period), is_force_(is_force), median_size_(toSeconds(period)) {}

  enum class Verdict {
    kPasses,
    kRejected,
    kBeginsAnew,  ///< passes, but the clock went back: what came before belongs to another series
  };

  /// Looks at the next reading. A reading that is rejected for its stamp leaves no trace but in the counters.
  Verdict judge(Stamp stamp, double acceleration);

  /// Forgets the last stamp: the next reading may have any.
  void startNewSeries();

  /// @return true if the last kSignalTuning.stuck readings were all the same: a sensor that is stuck, or a
  /// vehicle at rest and a sensor that resolves coarsely. Which of the two, the strut's other sensor tells.
  bool isStill() const { return statistics_.equal_in_a_row == kSignalTuning.stuck; }

  /// @return the mean distance of the newest thousand readings from their mean [m/s^2].
  double deviation() const { return statistics_.distance.mean(); }

  /// @return how far from that mean any reading has been [m/s^2], those that were kept out as absurd left out.
  double farthest() const;

  const RejectCounts& rejected() const { return rejected_; }
  const StreamClock& clock() const { return clock_; }

  /// @return when the last reading was taken (StreamClock); empty if it was kept out.
  const std::optional<Stamp>& taken() const { return taken_; }

 private:
  std::optional<RejectReason> faultOfStamp(Stamp stamp) const;
  bool isAbsurd(double acceleration);
  bool isClipped(double acceleration);
  Verdict reject(RejectReason reason);

  Stamp longest_overtaking_;
  bool is_force_;
  std::optional<Stamp> last_;
  int believed_ = kSignalTuning.believed_again;  // readings in a row that are not absurd, up to that
  RunningMedian median_size_;                    // |acceleration|, of all that are numbers
  ReadingStatistics statistics_;                 // of all readings that passed, the clipped ones included
  RangeEnd upper_{1.0}, lower_{-1.0};            // likewise
  RejectCounts rejected_;
  StreamClock clock_;
  std::optional<Stamp> taken_;
};

}  // namespace suspension_health_monitor
