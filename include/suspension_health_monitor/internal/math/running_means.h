#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

/// Means of N quantities with exponential forgetting, sum lambda^(k-i) x_i / sum lambda^(k-i): unbiased from the first
/// value on.
template <std::size_t N>
class RunningMeans {
 public:
  /// @param forgetting_factor  lambda in (0, 1].
  explicit RunningMeans(double forgetting_factor) : forgetting_factor_(forgetting_factor) {}

  void add(const std::array<double, N>& values) {
    weight_ = forgetting_factor_ * weight_ + 1.0;
    const double gain = 1.0 / weight_;
    for (std::size_t i = 0; i < N; ++i) means_[i] += gain * (values[i] - means_[i]);
  }

  /// Of one quantity.
  void add(double value) { add(std::array<double, N>{value}); }

  /// From now on; what has been taken in keeps its weight.
  void setForgettingFactor(double forgetting_factor) { forgetting_factor_ = forgetting_factor; }

  double mean(std::size_t i = 0) const { return means_[i]; }  ///< 0 before the first values
  double weight() const { return weight_; }                   ///< sum lambda^(k-i), at most 1 / (1 - lambda)

 private:
  double forgetting_factor_;
  double weight_ = 0.0;
  std::array<double, N> means_{};
};

/// The mean of one quantity.
using RunningMean = RunningMeans<1>;

/// A mean with exponential forgetting that no few values move far, however large they are: a value
/// counts as at most kProven mean deviations from the mean, however far off it is. Wrong values without a break widen
/// what is usual by a factor of e in 1 / (kProven - 1) of the memory.
class LimitedMean {
 public:
  /// @param forgetting_factor  lambda in (0, 1].
  explicit LimitedMean(double forgetting_factor) : mean_(forgetting_factor), deviation_(forgetting_factor) {}

  void add(double value) {
    const double off = value - mean_.mean(), most = kProven * deviation_.mean();
    const double limited = most > 0.0 ? std::clamp(off, -most, most) : off;
    mean_.add(mean_.mean() + limited);
    deviation_.add((1.0 - 1.0 / mean_.weight()) * std::abs(limited));  // from the new mean: 0 of the first value
  }

  double mean() const { return mean_.mean(); }
  double deviation() const { return deviation_.mean(); }  ///< mean distance from the mean

 private:
  RunningMean mean_, deviation_;
};

/// How well a prediction follows a measurement, over an exponential window.
/// A constant difference is left out of both figures: the offsets of two accelerometers are no fault of the model.
class RunningComparison {
 public:
  /// @param forgetting_factor  lambda in (0, 1]; window of 1 / (1 - lambda) samples.
  explicit RunningComparison(double forgetting_factor)
      : means_(forgetting_factor),
        residual_(forgetting_factor),
        measured_(forgetting_factor),
        worse_(forgetting_factor),
        half_weight_(0.5 / (1.0 - std::min(forgetting_factor, 1.0 - 1e-12))) {}

  void add(double measured, double predicted) {
    const double residual = measured - predicted;
    means_.add({residual, residual * residual, measured, measured * measured});
    residual_.add(residual);
    measured_.add(measured);
    worse_.add(std::abs(residual - residual_.mean()) > std::abs(measured - measured_.mean()) ? 1.0 : 0.0);
  }

  /// @return true if the prediction was farther from the measurement than a constant for more than half of the window,
  /// once half of its weight is in. It asks how often, not by how much: a sum of squares that holds one wrong reading
  /// of a thousand times the usual forgets it after fourteen windows.
  bool isWorseThanConstant() const { return means_.weight() > half_weight_ && worse_.mean() > 0.5; }

  /// @return root mean square of (measured - predicted) about its mean; 0 before the first sample.
  double rmse() const { return deviation(kResidual, kSquareResidual); }

  /// @return 100 (1 - |y - yhat| / |y - mean y|), 100 for a perfect model, 0 for a constant; below 0 is worse than
  /// that. NaN while the measurement has not moved.
  double fitPercent() const {
    const double spread = deviation(kMeasured, kSquareMeasured);
    return spread > 0.0 ? 100.0 * (1.0 - rmse() / spread) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  enum Mean : std::size_t { kResidual, kSquareResidual, kMeasured, kSquareMeasured, kNumMeans };

  double deviation(Mean value, Mean square) const {
    return std::sqrt(std::max(0.0, means_.mean(square) - means_.mean(value) * means_.mean(value)));
  }

  RunningMeans<kNumMeans> means_;
  LimitedMean residual_, measured_;
  RunningMean worse_;  // 1 where the prediction is farther off than the mean measurement, else 0
  double half_weight_;
};

}  // namespace suspension_health_monitor
