#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// How strong a signal is at half its sampling rate, where what lies beyond begins to be folded back: the power behind
/// the filter with the weights +1, -1, +1, .., of a band of about a sixteenth, in windows of that many values. A few
/// windows of any power, as a corrupt reading makes them, count like strong ones of the signal (LimitedMean).
/// Cost per value: O(1), no allocation.
class SamplingLimitPower {
 public:
  /// @param forgetting_factor  lambda in (0, 1].
  explicit SamplingLimitPower(double forgetting_factor) : power_(forgetting_factor), at_limit_(forgetting_factor) {}

  /// Takes in the next value of a uniform series, without its mean.
  void add(double value) {
    newest_[size_++ % newest_.size()] = value;
    if (size_ < newest_.size()) return;
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < newest_.size(); i += 2) {
      sum += newest_[i] - newest_[i + 1];
      squares += newest_[i] * newest_[i] + newest_[i + 1] * newest_[i + 1];
    }
    const double counted = power_.add(squares / static_cast<double>(newest_.size()));
    at_limit_.add(squares > 0.0 ? counted * (sum * sum / squares) : 0.0);
  }

  /// The next value begins another series.
  void startNewSeries() { size_ = 0; }

  /// @return power density there over the mean one: 1 for white noise; 0 without any motion.
  double density() const { return power_.mean() > 0.0 ? at_limit_.mean() / power_.mean() : 0.0; }

  /// @return rms of white noise of that density [unit of the values].
  double level() const { return std::sqrt(at_limit_.mean()); }

 private:
  std::array<double, 16> newest_{};
  std::size_t size_ = 0;
  LimitedMean power_;
  RunningMean at_limit_;
};

}  // namespace suspension_health_monitor
