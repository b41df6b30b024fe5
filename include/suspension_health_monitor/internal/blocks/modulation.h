#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>

#include "suspension_health_monitor/internal/blocks/block_options.h"

namespace suspension_health_monitor {

/// Modulating functions hann(t) e^(-j w_k t). They and their first derivatives vanish at both ends of the block, so
/// that derivatives up to the second move from the signal onto them by parts, without terms of the ends: from the plain
/// Fourier integrals U of a signal delayed by tau, with s_k = j w_k,
///     H_p(U)_k = s_k^p U_k e^(s_k tau) / 2 - (s_(k-1)^p U_(k-1) e^(s_(k-1) tau) + s_(k+1)^p U_(k+1) e^(s_(k+1) tau)) /
///     4
/// is the integral of hann(t) e^(-j w_k t) times the p-th derivative, in bins first .. last.
class Modulation {
 public:
  static constexpr int kDerivatives = 4;  ///< p = 0 .. 3; a gyro's derivative needs one more than an acceleration's

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
  std::array<Eigen::ArrayXcd, kDerivatives> weights_;  // s^p e^(s tau)
};

}  // namespace suspension_health_monitor
