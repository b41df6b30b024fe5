#pragma once

#include <cstddef>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/identification/running_mean.h"

namespace suspension_health_monitor {

/// How well a prediction follows a measurement, over an exponential window.
/// A constant difference is left out of both figures: the offsets of two accelerometers are no fault of the model.
class RunningComparison {
 public:
  /// @param forgetting_factor  lambda in (0, 1]; window of 1 / (1 - lambda) samples.
  explicit RunningComparison(double forgetting_factor);

  void add(double measured, double predicted);

  /// @return true if the prediction was farther from the measurement than a constant for more than half of the window,
  /// once half of its weight is in. It asks how often, not by how much: a sum of squares that holds one wrong reading
  /// of a thousand times the usual forgets it after fourteen windows.
  bool isWorseThanConstant() const { return means_.weight() > half_weight_ && worse_.mean() > 0.5; }

  /// @return root mean square of (measured - predicted) about its mean; 0 before the first sample.
  double rmse() const;

  /// @return 100 (1 - |y - yhat| / |y - mean y|), 100 for a perfect model, 0 for a constant; below 0 is worse than
  /// that. NaN while the measurement has not moved.
  double fitPercent() const { return fitPercent(rmse()); }

  /// The same, for a caller that has rmse() already.
  double fitPercent(double rmse) const;

 private:
  enum Mean : std::size_t { kResidual, kSquareResidual, kMeasured, kSquareMeasured, kNumMeans };

  double deviation(Mean value, Mean square) const;

  RunningMeans<kNumMeans> means_;
  LimitedMean residual_, measured_;
  RunningMean worse_;  // 1 where the prediction is farther off than the mean measurement, else 0
  double half_weight_;
};

}  // namespace suspension_health_monitor
