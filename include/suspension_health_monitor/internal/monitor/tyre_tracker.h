#pragma once

#include <optional>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"
#include "suspension_health_monitor/internal/identification/regression.h"
#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/monitor/validity_gate.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Position of the wheel's parameters in theta, the first two in place of the strut's.
enum TyreParameter : int {
  kDampingToWheelMass = 0,    ///< beta/m [1/s]
  kStiffnessToWheelMass = 1,  ///< K/m [1/s^2]
  kTyreToWheelMass = 2,       ///< K0/m [1/s^2]
  kNumTyreParameters = 3
};

/// Rows of the wheel's regression from three accelerations: Eq. (2), m w'' = beta (z' - w') + K (z - w) + K0 (mu - w),
/// differentiated twice and under the twofold integral, as SuspensionRegression does with Eq. (1):
///   I_2^2 w'' = -(beta/m) I_1^2 u - (K/m) I_0^2 u + (K0/m) I_0^2 (mu'' - w'') + e,   u = w'' - z'' [m/s^2].
/// The wheel is to the body what the body is to the wheel: these are its rows with both readings changed round, and a
/// column more. All three parameters are positive. A constant common to all sensors vanishes.
class TyreRegression {
 public:
  explicit TyreRegression(const IntegralFilterOptions& options) : rows_(options, 1, false, 0) {}

  /// Takes in the next sample of an uninterrupted uniform series.
  /// @param road_acceleration  mu'' where the tyre touches the road, up positive [m/s^2].
  /// @return as SuspensionRegression::push().
  const RegressionRow* push(const CornerSample& sample, double road_acceleration) {
    const double tyre = road_acceleration - sample.unsprung_acceleration;
    return rows_.push({sample.stamp, sample.unsprung_acceleration, sample.sprung_acceleration}, &tyre);
  }

  void reset() { rows_.reset(); }

 private:
  SuspensionRegression rows_;
};

/// Wheel and tyre of one strut, followed through a drive by LS and LA side by side, with a third accelerometer where
/// the tyre touches the road. Samples without a reading of it empty the filter, as does a gap: estimates hold
/// meanwhile, marked as not valid. Cost per sample: O(1), no allocation.
class TyreTracker {
 public:
  /// @param options  with sample_period given.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  explicit TyreTracker(const MonitorSettings& options);

  /// Takes in the next sample of the strut.
  /// @param road_acceleration  mu'' at this sample [m/s^2]; none: the road's sensor is silent.
  const TyreReport& add(const CornerSample& sample, const std::optional<double>& road_acceleration);

  /// @param fits  false: no estimate is valid from the next sample on, as samples do not come at the sample period.
  void setPeriodFits(bool fits) { period_fits_ = fits; }

  const TyreReport& report() const { return report_; }

 private:
  void estimate(const RegressionRow& row);
  void judge();

  int horizon_samples_;
  Stamp period_;
  double fewest_rows_;
  bool period_fits_ = true;
  SilentRows silent_rows_;
  TyreRegression regression_;
  RecursiveLeastSquares least_squares_;
  RecursiveLeastAbsolute least_absolute_;
  std::optional<Stamp> last_stamp_;
  TyreReport report_;
};

}  // namespace suspension_health_monitor
