#pragma once

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// A mean with exponential forgetting that no few values move far, however large they are: each counts by its distance
/// from the mean, at most kFar of the usual one. A wrong value of any size so moves the mean by what kFar deviations
/// would, and wrong values without a break widen what is usual by a factor of e in 1 / (kFar - 1) of the memory.
class LimitedMean {
 public:
  /// @param forgetting_factor  lambda in (0, 1].
  explicit LimitedMean(double forgetting_factor) : mean_(forgetting_factor), deviation_(forgetting_factor) {}

  void add(double value) {
    const double off = value - mean_.mean(), most = kFar * deviation_.mean();
    const double limited = most > 0.0 ? std::clamp(off, -most, most) : off;
    mean_.add(mean_.mean() + limited);
    deviation_.add((1.0 - 1.0 / mean_.weight()) * std::abs(limited));  // from the new mean: 0 of the first value
  }

  double mean() const { return mean_.mean(); }
  double deviation() const { return deviation_.mean(); }  ///< mean distance from the mean

 private:
  static constexpr double kFar = 3.0;  // a normal variable is farther off once in sixty times, to both sides alike

  RunningMean mean_, deviation_;
};

}  // namespace suspension_health_monitor
