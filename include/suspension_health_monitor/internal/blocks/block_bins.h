#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "suspension_health_monitor/internal/blocks/tuning.h"

namespace suspension_health_monitor {

/// The bins of a block that the estimator uses: k = first .. last, w_k = 2 pi k / T. The Hann window mixes each bin
/// with its neighbours, so that spectra hold bins first - 1 .. last + 1. Symbols as in doc/equations.md, Block
/// estimate.
struct BlockBand {
  static constexpr int kFirst = 2;  ///< below, an offset and a drift of the sensors leak in through the Hann window
  static constexpr int kLast = 40;  ///< 20 times the first: from half the bounce to beyond the wheel's hop

  double length = 0.0;  ///< T [s]
  int first = kFirst, last = kLast;

  /// @param period  the longest sampling time of the streams [s]. Longer ones than T / 32 give no block.
  BlockBand(double block_length, double period)
      : length(block_length),
        last(static_cast<int>(std::clamp(kBlockTuning.usable * block_length / period, 1.0 * kFirst, 1.0 * kLast))) {}

  int size() const { return last - first + 1; }
  int spectrumSize() const { return last - first + 3; }
  double omega(int bin) const { return 2.0 * M_PI * bin / length; }  ///< [rad/s]
};

/// Bands of neighbouring bins within which the power of what is unexplained counts as equal. A band of n bins of one
/// block has n complex values, so that its power is known to 1 / sqrt(n); the widths grow with frequency as resonances
/// do.
class NoiseBands {
 public:
  static constexpr int kFewestBins = 5;
  static constexpr int kMost = (BlockBand::kLast - BlockBand::kFirst + 1) / kFewestBins;
  static constexpr double kRatio = 1.25;  ///< upper over lower end: a third of an octave

  explicit NoiseBands(const BlockBand& band) {
    for (int from = 0; from < band.size();) {
      int to = from + kFewestBins;
      while (band.first + to < kRatio * (band.first + from)) ++to;
      if (band.size() - to < kFewestBins) to = band.size();
      edges_.push_back(to);
      from = to;
    }
  }

  int count() const { return static_cast<int>(edges_.size()) - 1; }
  int first(int band) const { return edges_[band]; }  ///< bin, counted from the lowest used
  int size(int band) const { return edges_[band + 1] - edges_[band]; }

 private:
  std::vector<int> edges_{0};  // first bins, and the end of the last band
};

/// Modulating functions hann(t) e^(-j w_k t). They and their first derivatives vanish at both ends of the block, so
/// that derivatives up to the second move from the signal onto them by parts, without terms of the ends: from the plain
/// Fourier integrals U of a signal delayed by tau, with s_k = j w_k,
///     H_p(U)_k = s_k^p U_k e^(s_k tau) / 2 - (s_(k-1)^p U_(k-1) e^(s_(k-1) tau) + s_(k+1)^p U_(k+1) e^(s_(k+1) tau)) /
///     4
/// is the integral of hann(t) e^(-j w_k t) times the p-th derivative, in bins first .. last.
class Modulation {
 public:
  explicit Modulation(const BlockBand& band) : s_(band.spectrumSize()) {
    for (Eigen::Index i = 0; i < s_.size(); ++i) s_[i] = {0.0, band.omega(band.first - 1 + static_cast<int>(i))};
    for (auto& each : weights_) each.resize(s_.size());
    setDelay(0.0);
  }

  /// @param delay  tau by which the signals are stamped late [s].
  void setDelay(double delay) {
    weights_[0] = (s_ * delay).exp();
    for (std::size_t p = 1; p < weights_.size(); ++p) weights_[p] = weights_[p - 1] * s_;
  }

  /// @param integrals  U in bins first - 1 .. last + 1.
  /// @param result  H_p(U) in bins first .. last.
  template <class Integrals, class Result>
  void apply(std::size_t p, const Integrals& integrals, Result&& result) const {
    const Eigen::Index n = s_.size() - 2;
    const auto& w = weights_[p];
    result = 0.5 * w.segment(1, n) * integrals.segment(1, n) -
             0.25 * (w.head(n) * integrals.head(n) + w.tail(n) * integrals.tail(n));
  }

  auto s() const { return s_.segment(1, s_.size() - 2); }  ///< s_k in bins first .. last [1/s]

 private:
  Eigen::ArrayXcd s_;
  // s^p e^(s tau), p = 0 .. 3: a gyro's derivative needs one more than an acceleration's.
  std::array<Eigen::ArrayXcd, 4> weights_;
};

}  // namespace suspension_health_monitor
