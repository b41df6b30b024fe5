#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// How strong a signal is at half its sampling rate, where what lies beyond begins to be folded back: the power behind
/// the filter with the weights +1, -1, +1, .., of a band of about a sixteenth.
/// Cost per value: O(1), no allocation.
class SamplingLimitPower {
 public:
  /// @param forgetting_factor  lambda in (0, 1].
  explicit SamplingLimitPower(double forgetting_factor) : means_(forgetting_factor) {}

  /// Takes in the next value of a uniform series, without its mean.
  void add(double value) {
    newest_[size_++ % newest_.size()] = value;
    if (size_ < newest_.size()) return;
    double sum = 0.0;
    for (std::size_t i = 0; i < newest_.size(); i += 2) sum += newest_[i] - newest_[i + 1];
    means_.add({sum * sum / static_cast<double>(newest_.size()), value * value});
  }

  /// The next value begins another series.
  void startNewSeries() { size_ = 0; }

  /// @return power density there over the mean one: 1 for white noise; 0 without any motion.
  double density() const { return means_.mean(1) > 0.0 ? means_.mean(0) / means_.mean(1) : 0.0; }

  /// @return rms of white noise of that density [unit of the values].
  double level() const { return std::sqrt(means_.mean(0)); }

 private:
  std::array<double, 16> newest_{};
  std::size_t size_ = 0;
  RunningMeans<2> means_;  // of the filter's squared output; of the squared value
};

}  // namespace suspension_health_monitor
