#pragma once

#include <optional>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/monitor/strut_identifier.h"
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
  /// @param road_acceleration  mu'' at this sample, up positive [m/s^2]; none: the road's sensor is silent.
  const TyreReport& add(const CornerSample& sample, const std::optional<double>& road_acceleration);

  /// @param fits  false: no estimate is valid from the next sample on, as samples do not come at the sample period.
  void setPeriodFits(bool fits) { of_input_.period_fits = fits; }

  const TyreReport& report() const { return report_; }

 private:
  WheelEstimate wheelOf(const StrutEstimate& estimate) const;

  Stamp period_;
  EstimateFacts of_input_;
  StrutIdentifier identifier_;
  StrutEstimate ls_, la_;  // of the wheel in the fields of a strut; coefficients[0] is K0/m
  std::optional<Stamp> last_stamp_;
  TyreReport report_;
};

}  // namespace suspension_health_monitor
