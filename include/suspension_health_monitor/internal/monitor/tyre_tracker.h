#pragma once

#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"
#include "suspension_health_monitor/internal/identification/recursive_least_absolute.h"
#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"
#include "suspension_health_monitor/internal/identification/regression.h"
#include "suspension_health_monitor/internal/monitor/validity_gate.h"
#include "suspension_health_monitor/internal/monitor_settings.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

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
  bool continues(Stamp stamp) const;
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
