#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/math/delay_line.h"
#include "suspension_health_monitor/internal/math/running_means.h"

namespace suspension_health_monitor {

/// Whether the readings of a stream were taken regularly, or when their stamps say. With d_k the distance of a stamp
/// from the regular time, a reading is x(regular) if it was taken regularly, and x(regular) + x' d_k if it was taken as
/// stamped. Fourth differences D take a slow signal out of the readings x_k: e = D x_k is left in the first case, e - r
/// in the second, with r = D (x'_k d_k) and x' from the readings next to x_k. The case with the smaller sum of squares
/// over the newest 10 000 readings is the likelier one. Where x' is noise the test has no power, but then d_k does no
/// harm. Cost per reading: O(1), no allocation.
class SamplingTest {
 public:
  /// Takes in the next reading.  @param off  d_k, in periods.
  void add(double value, double off);

  /// Readings are missing before the next one.
  void interrupt() { values_.reset(); }

  /// @return true if that is likelier; both false: there are no readings yet, or they do not move. The sums of squares
  /// of e - r and e differ by r^2 - 2 r e.
  bool isRegular() const { return products_.mean(0) > 2.0 * products_.mean(1); }
  /// @return true if it is kConvincing times as likely, fourth differences next to each other counting once.
  bool isCertainlyRegular() const;
  bool isAsStamped() const { return products_.mean(0) < 2.0 * products_.mean(1); }

 private:
  static constexpr int kReach = 1;  // of a derivative, to either side
  static constexpr int kHalf = 2;   // of a fourth difference
  static constexpr int kWindow = 2 * (kReach + kHalf) + 1;

  DelayLine values_{kWindow}, off_{kWindow};
  RunningMeans<3> products_{0.9999};  // r^2, r e, e^2
};

/// When the readings of one stream were taken, by their stamps: phase and period of a stream that reads regularly, by
/// one alpha-beta filter, whose gains are those of least squares over the newest 1000 readings (Kalata, IEEE Trans.
/// AES 20 (1984), 174-182). A stamp near the regular time is used as it is, unless the readings show that they were
/// taken regularly (SamplingTest). One farther off usually follows several lost readings, whose number it tells; if
/// messages were seen to wait, the regular time is used instead, unless the readings show that they were taken as
/// stamped. Cost per reading: O(1), no allocation.
class StreamClock {
 public:
  static constexpr double kMemory = 0.999;  ///< forgetting factor

  /// Takes in the stamp of the next reading, later than the one before.
  /// @return when the reading was taken, likewise later.
  Stamp add(Stamp stamp, double value);

  /// A reading is kept out, which was taken, too.
  void passOver() { time_ += period_; }

  /// The next reading begins another series: its stamp may be any.
  void interrupt();

  /// @return until when stamps were taken as they are, though the readings showed later that they had certainly
  /// been taken regularly; the least stamp of all if they do not.
  Stamp settled() const { return sampling_.isCertainlyRegular() ? settled_ : Stamp::min(); }

  double period() const { return period_; }                     ///< [s]; 0 before the second reading
  double jitter() const { return std::sqrt(jitter_.mean()); }   ///< standard deviation of the spacing [s]
  std::uint64_t lost() const { return lost_ > 0 ? lost_ : 0; }  ///< readings that are missing, pauses left out

 private:
  static constexpr std::size_t kFirst = 512;  // readings that tell the first period

  /// @return true while phase and period rest on fewer readings than are remembered.
  bool isLearning() const { return readings_ < std::round(1.0 / (1.0 - kMemory)); }
  double medianSpacing(std::size_t over) const;
  double likeliestPeriod(double rough) const;
  void begin(double stamp);
  void follow(double stamp);
  int periodsSinceLast(double stamp);

  std::optional<Stamp> origin_, last_;  // of the series; the newest time returned
  Stamp settled_ = Stamp::min();        // newest stamp before it told how it was taken
  std::array<double, kFirst> first_{};  // stamps [s since the origin]
  std::size_t num_first_ = 0;
  double time_ = 0.0, period_ = 0.0;        // regular time of the newest reading [s since the origin], period [s]
  double stamp_ = 0.0;                      // the newest one, likewise
  double readings_ = 0.0;                   // that phase and period rest on
  double miscount_ = 0.0, evidence_ = 0.0;  // periods that the count may be short of, ln of its likelihood ratio
  double whole_before_ = 0.0;               // periods that the newest reading was off by
  int waits_ = 0;  // kSignalTuning.miscount from a message that waited, less one each time several are lost in a row
  int out_of_step_ = 0;
  RunningMean square_{kMemory}, jitter_{kMemory};  // of the distance from the regular time, of the spacing [s^2]
  std::int64_t lost_ = 0;
  SamplingTest sampling_;
};

}  // namespace suspension_health_monitor
