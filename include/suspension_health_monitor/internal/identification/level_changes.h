#pragma once

#include <algorithm>
#include <cstddef>

#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/identification/slow_mean.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {

/// How much of the regressor of stiffness, I_0^2 u'', is no motion but the level of the sensors' difference, where that
/// changes: an IMU that is tilted reads a part of braking and of bends, one that warms up drifts. A level that stays is
/// in the constant column. A level is what is much slower than a body oscillates on its springs (SlowMean). It changes
/// by no more than the regressor does, nor by more than the residuals over b0, for the body does not answer it: motion
/// that slow is in the regressor, and in the residuals where a level has pulled b0 down, but hardly ever in both. Cost
/// per row: O(1), no allocation.
class LevelChanges {
 public:
  /// @param period  of the rows [s].  @param forgetting_factor  of the estimators.
  LevelChanges(double period, double forgetting_factor)
      : regressor_(period), unanswered_(regressor_), moments_(forgetting_factor) {}

  /// Takes in the next row of an uninterrupted series: its regressor of stiffness, and its residual over b0 [m].
  /// @param is_remembered  the estimate of the stiffness rests on it, too.
  void add(double regressor, double unanswered, bool is_remembered) {
    const double level = regressor_.push(regressor), slow = unanswered_.push(unanswered);
    if (regressor_.full() && is_remembered) moments_.add({level, square(level), square(slow)});
  }

  /// The next row does not follow the one before.
  void interrupt() {
    regressor_.reset();
    unanswered_.reset();
  }

  void setForgettingFactor(double forgetting_factor) { moments_.setForgettingFactor(forgetting_factor); }

  /// @return of the level, in the memory [m^2].
  double variance() const {
    return std::clamp(moments_.mean(kLevelSquare) - square(moments_.mean(kLevel)), 0.0, moments_.mean(kUnanswered));
  }

 private:
  enum Moment : std::size_t { kLevel, kLevelSquare, kUnanswered, kNumMoments };

  SlowMean regressor_, unanswered_;
  RunningMeans<kNumMoments> moments_;
};

}  // namespace suspension_health_monitor
