#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

namespace suspension_health_monitor {

/// One equation psi(k) = phi(k)' theta + e(k) of the regression (10).
struct RegressionRow {
  Eigen::VectorXd regressor;  ///< phi, one entry per parameter [unit of output / unit of parameter]
  double output = 0.0;        ///< psi

  /// @return true if no parameter can make a difference to this row.
  bool saysNothing() const { return regressor.isZero(0.0); }
};

/// Position of the strut's own parameters in theta, Eq. (30).
enum StrutParameter : int { kDampingToMass = 0, kStiffnessToMass = 1, kNumStrutParameters = 2 };

/// Rows of the strut regression from the two accelerations, Eq. (28)-(30), with a column more for every effect:
///   I_2^2 y = b1 I_1^2 u + b0 I_0^2 u + sum_j c_j I_2^2 f_j + c_o h^2 + e,   y = z'' [m/s^2], u = w'' - z'' [m/s^2],
/// with b1 = beta/M [1/s] and b0 = K/M [1/s^2]. It is the model (27) differentiated twice, so that only accelerations
/// occur, under the twofold integral, so that nothing is differentiated in fact.
/// The effects' f_j, per unit of c_j, come from an observer of the travel (free_run.h).
/// A constant in y vanishes from psi; a constant common to both sensors vanishes from u. A constant o in u, the offset
/// between the sensors, adds h^2 o to the column of b0 and vanishes from that of b1; two more columns, if they are
/// wanted, take it out again: c_o = -b0 o of the newest reading, and, as one that drifts by r in a row is that of m
/// rows ago in the middle of the window, c_r = -b0 r with the column -m h^2. Cost per sample: O(1), no allocation.
class SuspensionRegression {
 public:
  /// @param drifting_offset  true: the last two columns are c_o and c_r.
  /// @param effect_derivative  0: the effects' columns are I_0^2 f_j, as if f_j were an acceleration.
  explicit SuspensionRegression(const IntegralFilterOptions& options, std::size_t num_effects = 0,
                                bool drifting_offset = false, int effect_derivative = 2);

  /// Takes in the next sample of an uninterrupted uniform series (only the accelerations are used).
  /// @param effect_forces  f_j at this sample, one per effect.
  /// @return the row, owned by this object and valid until the next call; nullptr while the filter fills.
  const RegressionRow* push(const CornerSample& sample, const double* effect_forces = nullptr);

  /// Starts anew after a gap.
  void reset();

 private:
  LinearIntegralFilter sprung_;
  LinearIntegralFilter relative_;
  std::vector<LinearIntegralFilter> effects_;
  int effect_derivative_;
  bool drifting_offset_;
  double offset_gain_;  // h^2 [s^2]
  double drift_rows_;   // from the middle of the window to the newest reading
  RegressionRow row_;
};

}  // namespace suspension_health_monitor
