#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/internal/identification/limited_mean.h"

namespace suspension_health_monitor {

/// How much a sensor may shake about its sampling rate and beyond, which sampling folds back upon slow motion.
///
/// Beyond its hop a wheel shakes the less the faster, by a power law that falls ever steeper. So the power density at
/// 5/8 of half the rate and that at half the rate, continued by their slope to the rate itself, bound what is folded:
/// they are one to five times it on the roads and wheels of `folding_table`. A filter before the sampling makes that
/// slope steep and the bound small. Densities are those of windows tapered by Hann (Harris, Proc. IEEE 66 (1978),
/// 51-83), of which a few of any size, as corrupt readings make them, count like strong ones (LimitedMean).
///
/// Cost per value: O(1), no allocation.
class FoldedPower {
 public:
  /// @param forgetting_factor  lambda in (0, 1], of the values.
  explicit FoldedPower(double forgetting_factor) : below_(std::pow(forgetting_factor, kEvery)), at_limit_(below_) {}

  /// Takes in the next value of a uniform series.
  void add(double value);

  /// The next value begins another series.
  void interrupt() { size_ = 0; }

  /// @return rms of white noise as dense as what may be folded back [unit of the values].
  double level() const;

  /// @return rms of white noise as dense as the values are at half the rate: neither the sensor's noise nor what is
  /// folded back is more [unit of the values].
  double levelAtLimit() const { return std::sqrt(at_limit_.mean() / kLimited); }

 private:
  static constexpr std::size_t kWindow = 32;          // values: a band is an eighth of half the rate to either side
  static constexpr std::size_t kEvery = kWindow / 2;  // values from window to window, that hardly correlate

  static constexpr double kLimited = 0.882;  // LimitedMean of the squares of normal deviates, beside their mean

  std::array<double, kWindow> newest_{};
  std::size_t size_ = 0;  // of the series
  LimitedMean below_, at_limit_;
};

}  // namespace suspension_health_monitor
