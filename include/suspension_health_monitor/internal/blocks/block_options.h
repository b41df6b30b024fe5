#pragma once

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

/// Blocks of Fourier modulating functions, and what is assumed of the strut before any data. Every other number of the
/// estimator is derived from these where it stands. Symbols as in doc/equations.md, Block estimate.
struct BlockOptions {
  double length = 2.0;       ///< T of the first blocks [s]; then it follows the bounce by factors of two
  double enough = 0.0375;    ///< relative standard deviation of b1 and b0 that needs no more blocks: 0.15, the change
                             ///< that warns, over 4, the standard deviations that prove it [-]
  double gain_stddev = 0.1;  ///< prior of the difference of both sensors' gains: 0.8 to 1.25 are within 2.5 of it [-]
  double delay_stddev = 0.005;  ///< prior of the clocks' difference [s]
};

/// Share of the body's power from which a delay or a gain is that of a sensor: a law with memory, and whatever is
/// missing, looks like one, but leaves more unexplained: 4 % and more on measured and simulated records.
inline constexpr double kNearlyAll = 0.97;
/// Difference of both sensors' gains that is one. Links and the wheel's turning make up to 2 % on recorded multibody
/// vehicles, a law with memory up to 9 % on measured records, with a standard deviation of 2 %.
inline constexpr double kLeastGain = 0.05;

/// The bins of a block that the estimator uses: k = first .. last, w_k = 2 pi k / T. The Hann window mixes each bin
/// with its neighbours, so that spectra hold bins first - 1 .. last + 1.
struct BlockBand {
  static constexpr int kFirst = 2;  ///< below, an offset and a drift of the sensors leak in through the Hann window
  static constexpr int kLast = 40;  ///< 20 times the first: from half the bounce to beyond the wheel's hop
  static constexpr double kUsable = 0.35;  ///< of the rate: anti-alias filters of both IMUs differ beyond

  double length = 0.0;  ///< T [s]
  int first = kFirst, last = kLast;

  /// @param period  the longest sampling time of the streams [s]. Longer ones than T / 32 give no block.
  BlockBand(double block_length, double period)
      : length(block_length),
        last(static_cast<int>(std::clamp(kUsable * block_length / period, 1.0 * kFirst, 1.0 * kLast))) {}

  int size() const { return last - first + 1; }
  int spectrumSize() const { return last - first + 3; }
  double omega(int bin) const { return 2.0 * M_PI * bin / length; }  ///< [rad/s]
};

}  // namespace suspension_health_monitor
