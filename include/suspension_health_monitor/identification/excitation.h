#pragma once

#include <array>

#include "suspension_health_monitor/identification/regression_row.h"
#include "suspension_health_monitor/identification/running_mean.h"
#include "suspension_health_monitor/identification/suspension_regression.h"

namespace suspension_health_monitor {

/// Whether the rows of a strut tell anything of its damping and of its stiffness, or only of the sensors' noise, as those
/// of a parked vehicle do.
///
/// The regressors phi_1 = I_1^2 u and phi_0 = I_0^2 u are the directions of excitation: neither noise (one impulse response is
/// odd, the other even) nor motion (one is the other's derivative) correlates them, so that the information matrix is
/// close to diagonal. Over blocks of a horizon and more, parameter i is not excited if both
/// - its information, the mean of phi_i^2, has fallen below 3 % of what the estimate rests on: that of the blocks in
///   which it was excited, over ten memories; and
/// - what the held model makes of it, the mean of |theta_i phi_i|, is below 1.5 times the residual: noise of the sensors
///   gives at most about one, since it is in psi as well.
/// So a road that is merely smoother goes on counting, and so does a strut or a sensor that has changed, or a drive whose
/// readings are noise to the eye. A constant of phi_0 is the offset between the sensors and not counted.
/// Looked at is every eighth row: rows change slowly. Cost per row: O(1) whatever L, no allocation. Free of units.
class Excitation {
 public:
  static constexpr int kJudgeEvery = 8;  // rows

  /// @param horizon_samples  L of the filter.  @param forgetting_factor  of the estimator.
  Excitation(int horizon_samples, double forgetting_factor);

  /// Takes in a row, to be called every kJudgeEvery rows.
  /// @param theta  estimate, as many entries as the regressor: b1 [1/s], b0 [1/s^2], and those of effects.
  /// @return true if excited() or ratio() may have changed.
  [[gnu::noinline]] bool judge(const RegressionRow& row, const Eigen::VectorXd& theta);

  /// From now on the estimate is one that is worth being held; before, everything counts as excited.
  void arm() { armed_ = true; }

  bool excited(StrutParameter i) const { return parts_[i].excited; }

  /// @return mean |theta_i phi_i| over mean |epsilon| of the last block [-]; NaN before it.
  double ratio(StrutParameter i) const { return parts_[i].ratio; }

  /// Starts a block anew after a gap; what was excited stays so.
  void reset();

 private:
  /// What is known of one parameter's part of the rows.
  struct Part {
    double information = 0.0;  // of the block: sum of phi_i^2
    double size = 0.0;         // of the block: sum of |theta_i phi_i|
    double usual = 0.0;        // mean phi_i^2 of the blocks in which it was excited
    double blocks = 0.0;       // in that mean
    double ratio;
    bool excited = true;
  };

  void closeBlock();

  int looks_per_block_;
  double most_blocks_;  // of the mean
  int looks_ = 0;       // of the block
  double residual_ = 0.0;  // of the block: sum of |epsilon|
  RunningMean offset_;     // of phi_0
  std::array<Part, kNumStrutParameters> parts_;
  bool armed_ = false;
};

}  // namespace suspension_health_monitor
