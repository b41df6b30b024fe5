#pragma once

#include <utility>
#include <vector>

namespace suspension_health_monitor {

/// Values of a sampled signal between its samples: a weighted sum of the twelve samples on either side, whose weights
/// minimise a mean square error over all frequencies up to 0.9 of Nyquist's, the low ones counting most.
/// A wheel on a rough road is shaken close to that limit, where straight lines and even cubic splines leave errors of
/// the size of the sensor noise. Here a sine is good to kAccuracy of its amplitude up to 0.5 of Nyquist's frequency, to
/// 1e-3 up to 0.75, and to 2e-2 at 0.88. Source: least squares fractional delay, Laakso, Valimaki, Karjalainen and
/// Laine, IEEE Signal Processing Magazine 13 (1996), 30-60, eq. (35)-(38).
class BandlimitedInterpolator {
 public:
  static constexpr int kHalfWidth = 12;
  static constexpr double kAccuracy = 2e-4;  ///< of a sine's amplitude, up to half of Nyquist's frequency

  /// @param fraction  position between sample k (0) and sample k + 1 (1).
  explicit BandlimitedInterpolator(double fraction);

  /// @param around  the 2 kHalfWidth samples k - kHalfWidth + 1 .. k + kHalfWidth.
  double operator()(const double* around) const {
    double sum = 0.0;
    for (int i = 0; i < 2 * kHalfWidth; ++i) sum += weights_[static_cast<std::size_t>(i)] * around[i];
    return sum;
  }

  /// The integral of the signal from one position to another, weighted by (to - position)^power: power 0 turns an
  /// acceleration into the gain of velocity, power 1 into the gain of position. In samples; multiply by T^(1 + power).
  static BandlimitedInterpolator integral(double from, double to, int power);

  const std::vector<double>& weights() const { return weights_; }  ///< one per sample, the oldest first

 private:
  explicit BandlimitedInterpolator(std::vector<double> weights) : weights_(std::move(weights)) {}

  std::vector<double> weights_;
};

}  // namespace suspension_health_monitor
