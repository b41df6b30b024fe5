#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

/// Low-pass filtered signals and the derivatives of others, all of them by the same low-pass filter H: any linear
/// relation between signals and derivatives at one instant, such as a = alpha x r with alpha = omega', holds between
/// what comes out as well.
///
/// A gyro's white noise grows with the frequency when it is differentiated, so H ends where the motion does, not at
/// Nyquist's frequency. Both filters are FIR, kDelay samples to either side, h symmetrical and g antisymmetrical: they
/// delay by kDelay samples exactly, at all frequencies. No FIR filter is exactly j 2 pi f H of another one; the taps
/// are those of the least mean square of
/// - H - 1 up to kFlat, and H from kStop on, in cycles per sample,
/// - T G - j 2 pi f T H at all frequencies, whose mean square counts kSameFilter times that of the others, since an
/// error
///   of G is one of the relation while an error of H is none,
/// with H(0) = 1 and G'(0) = j 2 pi: a constant, gravity say, and the rate of a ramp pass exactly.
/// Then |H - 1| < 1e-3 up to kFlat, |H| < 1e-3 from kStop on, and |T G - j 2 pi f T H| < 1e-4 everywhere. Shorter
/// filters could not do that: the width of the transition is what they need their length for. Cost per instant:
/// O(signals), no allocation.
class MotionFilter {
 public:
  static constexpr int kDelay = 12;      ///< samples; so late is an instant
  static constexpr double kFlat = 0.24;  ///< of the sampling rate
  static constexpr double kStop = 0.42;  ///< of the sampling rate
  static constexpr double kSameFilter = 10.0;

  /// @param period  T > 0.
  /// @param filtered, differentiated  number of signals of either kind.
  MotionFilter(Stamp period, std::size_t filtered, std::size_t differentiated);

  struct Instant {
    Stamp stamp{};
    std::vector<double> values;  ///< of the filtered signals
    std::vector<double> rates;   ///< of the differentiated ones, per s
  };

  /// Takes in the next sample of all signals. One that follows less than half a period after the one before is left
  /// out; after a gap the filter fills anew.
  /// @param signals  the filtered ones, then those to differentiate.
  /// @return the instant kDelay samples ago, valid until the next call; nullptr while the filter fills.
  const Instant* push(Stamp stamp, const std::vector<double>& signals);

  void reset() { samples_ = 0; }

  /// @return standard deviation of what comes out where the signal's white noise has 1: of a value [-], of a rate
  /// [1/s].
  static double valueNoise();
  double rateNoise() const;

 private:
  static constexpr int kTaps = 2 * kDelay + 1;

  Stamp period_;
  Instant instant_;
  std::vector<double> history_;  // kTaps of every signal, twice so that they are in a row wherever the ring begins
  std::array<Stamp, kTaps> stamps_{};
  std::size_t newest_ = kTaps - 1;  // place in the ring
  int samples_ = 0;                 // since the last gap, up to kTaps
};

}  // namespace suspension_health_monitor
