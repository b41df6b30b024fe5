#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/internal/math/running_means.h"

namespace suspension_health_monitor {

/// Standard deviation of the white noise in a uniformly sampled signal, from its eighth differences: motion below an
/// eighth of the sampling rate passes them by less than 1e-3. A sensor's noise that is filtered near half the rate
/// comes out too small, in all channels of a sensor alike. No allocation.
class WhiteLevel {
 public:
  /// @param forgetting_factor  lambda in (0, 1].
  explicit WhiteLevel(double forgetting_factor) : size_(forgetting_factor) {}

  void add(double value) {
    for (double& difference : differences_) {
      const double before = difference;
      difference = value;
      value -= before;
    }
    if (filled_ < differences_.size()) {
      ++filled_;
      return;
    }
    // The squares of the binomial coefficients of order 8 add up to 12870.
    size_.add(std::abs(value) / std::sqrt(12870.0));
    ++count_;
  }

  /// After a gap.
  void startNewSeries() { filled_ = 0; }

  std::size_t count() const { return count_; }  ///< values that the deviation is known from

  /// Of a normal distribution, as far as that is known.
  double deviation() const { return std::sqrt(M_PI / 2.0) * size_.mean(); }

 private:
  std::array<double, 8> differences_{};
  std::size_t filled_ = 0, count_ = 0;
  LimitedMean size_;
};

}  // namespace suspension_health_monitor
