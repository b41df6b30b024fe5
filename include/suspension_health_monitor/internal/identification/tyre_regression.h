#pragma once

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/identification/regression_row.h"

namespace suspension_health_monitor {

/// Position of the wheel's parameters in theta.
enum TyreParameter : int {
  kDampingToWheelMass = 0,    ///< beta/m [1/s]
  kStiffnessToWheelMass = 1,  ///< K/m [1/s^2]
  kTyreToWheelMass = 2,       ///< K0/m [1/s^2]
  kNumTyreParameters = 3
};

/// Rows of the wheel's regression from three accelerations: Eq. (2), m w'' = beta (z' - w') + K (z - w) + K0 (mu - w),
/// differentiated twice and under the twofold integral, as SuspensionRegression does with Eq. (1):
///   I_2^2 w'' = -(beta/m) I_1^2 u - (K/m) I_0^2 u + (K0/m) I_0^2 (mu'' - w'') + e,   u = w'' - z'' [m/s^2].
/// All three parameters are positive. A constant common to all sensors vanishes.
/// Cost per sample: O(1), no allocation.
class TyreRegression {
 public:
  explicit TyreRegression(const IntegralFilterOptions& options);

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @param road_acceleration  mu'' where the tyre touches the road, up positive [m/s^2].
  /// @return the row, owned by this object and valid until the next call; nullptr while the filter fills.
  const RegressionRow* push(const CornerSample& sample, double road_acceleration);

  /// Starts anew after a gap.
  void reset();

 private:
  LinearIntegralFilter wheel_;
  LinearIntegralFilter strut_;  // of u
  LinearIntegralFilter tyre_;   // of mu'' - w''
  RegressionRow row_;
};

}  // namespace suspension_health_monitor
