#pragma once

#include <Eigen/Core>
#include <boost/circular_buffer.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/math/delay_line.h"

namespace suspension_health_monitor {

/// @param taps  of a LowPass; none: nothing is filtered.
/// @return the filtered signal. Where the filter reaches beyond an end, the value at the end goes on.
inline Eigen::VectorXd lowPassed(const std::vector<double>& taps, const Eigen::Ref<const Eigen::VectorXd>& signal) {
  if (taps.empty() || signal.size() == 0) return signal;
  const Eigen::Map<const Eigen::VectorXd> h(taps.data(), taps.size());
  const Eigen::Index size = signal.size(), reach = h.size() / 2;
  Eigen::VectorXd extended(size + 2 * reach), passed(size);
  extended << Eigen::VectorXd::Constant(reach, signal[0]), signal, Eigen::VectorXd::Constant(reach, signal[size - 1]);
  for (Eigen::Index k = 0; k < size; ++k) passed[k] = h.dot(extended.segment(k, h.size()));
  return passed;
}

/// The same in place.
inline void passLow(const std::vector<double>& taps, std::vector<double>& signal) {
  if (taps.empty()) return;
  Eigen::Map<Eigen::VectorXd> values(signal.data(), signal.size());
  values = lowPassed(taps, values);
}

/// A value between two samples is a weighted sum of so many samples on either side.
inline constexpr int kInterpolationReach = 12;
inline constexpr double kInterpolationAccuracy = 2e-4;  ///< of a sine's amplitude, up to half of Nyquist's frequency

/// Weights of the samples around for the value of a sampled signal between two of them. They minimise a mean square
/// error over all frequencies up to 0.9 of Nyquist's, the low ones counting most.
/// A wheel on a rough road is shaken close to that limit, where straight lines and even cubic splines leave errors of
/// the size of the sensor noise. Here a sine is good to kInterpolationAccuracy of its amplitude up to 0.5 of Nyquist's
/// frequency, to 1e-3 up to 0.75, and to 2e-2 at 0.88. Source: least squares fractional delay, Laakso, Valimaki,
/// Karjalainen and Laine, IEEE Signal Processing Magazine 13 (1996), 30-60, eq. (35)-(38).
/// @param fraction  position between sample k (0) and sample k + 1 (1).
/// @return weights of samples k - kInterpolationReach + 1 .. k + kInterpolationReach.
std::vector<double> interpolationWeights(double fraction);

/// The same for the integral of the signal from one position to another, weighted by (to - position)^power: power 0
/// turns an acceleration into the gain of velocity, power 1 into the gain of position. In samples; multiply by
/// T^(1 + power).
std::vector<double> integrationWeights(double from, double to, int power);

/// Low-pass filtered signals and the derivatives of others, all of them by the same low-pass filter H: any linear
/// relation between signals and derivatives at one instant, such as a = alpha x r with alpha = omega', holds between
/// what comes out as well.
///
/// A gyro's white noise grows with the frequency when it is differentiated, so H ends where the motion does, not at
/// Nyquist's frequency. Both filters are FIR, delay() samples to either side, h symmetrical and g antisymmetrical: they
/// delay by that exactly, at all frequencies. No FIR filter is exactly j 2 pi f H of another one; the taps are those of
/// the least mean square of
/// - H - 1 up to flat(), and H from stop() on,
/// - T G - j 2 pi f T H at all frequencies, whose mean square counts ten times that of the others, since an error of G
///   is one of the relation while an error of H is none,
/// with H(0) = 1 and G'(0) = j 2 pi: a constant, gravity say, and the rate of a ramp pass exactly.
/// Then |H - 1| < 1e-3 up to flat(), |H| < 1e-3 from stop() on, and |T G - j 2 pi f T H| < 1e-4 everywhere. Shorter
/// filters could not do that: the width of the transition is what they need their length for. Cost per instant:
/// O(signals / T), no allocation.
class MotionFilter {
 public:
  /// @param period  T > 0.
  /// @param filtered, differentiated  number of signals of either kind.
  MotionFilter(Stamp period, std::size_t filtered, std::size_t differentiated);

  struct Instant {
    Stamp stamp{};
    std::vector<double> values;      ///< of the filtered signals
    std::vector<double> rates;       ///< of the differentiated ones, per s
    std::vector<double> unfiltered;  ///< the signals to filter as they were at this instant
  };

  /// Takes in the next sample of all signals. One that follows less than half a period after the one before is left
  /// out; after a gap the filter fills anew.
  /// @param signals  the filtered ones, then those to differentiate.
  /// @return the instant delay() samples ago, valid until the next call; nullptr while the filter fills.
  const Instant* push(Stamp stamp, const std::vector<double>& signals);

  int delay() const { return delay_; }                       ///< samples; so late is an instant
  const Eigen::VectorXd& lowPass() const { return value_; }  ///< taps of H, 2 delay() + 1
  double flat() const { return flat_; }                      ///< [Hz]
  double stop() const;                                       ///< [Hz]

 private:
  Stamp period_;
  double flat_;
  int delay_;
  Eigen::VectorXd value_, rate_;  // taps from the oldest sample to the newest
  Instant instant_;
  std::vector<DelayLine> history_;        // of every signal, as many samples as taps
  boost::circular_buffer<Stamp> stamps_;  // of these samples since the last gap
};

/// Weights for the derivative of a uniformly sampled series: the slope, in the middle, of the cubic that fits 2 m + 1
/// samples best (least squares). Exact for polynomials of degree 4.
/// @param half_width  m >= 2.  @param period  T > 0 [s].
/// @return weights of x[k] - x[-k], k = 1 .. m.
Eigen::VectorXd slopeWeights(int half_width, double period);

inline constexpr int kWidestSlope = 12;  ///< the largest m that fittingSlope() takes

/// @return the weights of m = 2, 4, 8, 12, the narrowest with which noise is less than a thousandth of the slope's mean
/// square. The noise is what the fourth differences show: nothing that a series is worth sampling for has such.
/// @param series  each with kWidestSlope samples on either side of where slopes are wanted.
Eigen::VectorXd fittingSlope(const std::vector<std::vector<double>>& series, double period);

/// @param middle  with as many samples before and behind it as there are weights.
/// @return the slope there [unit/s].
double weightedSlope(const double* middle, const Eigen::VectorXd& weights);

/// @return standard deviation of the slope of white noise whose standard deviation is 1 [1/s].
inline double noiseOfSlope(const Eigen::VectorXd& weights) { return std::sqrt(2.0) * weights.norm(); }

}  // namespace suspension_health_monitor
