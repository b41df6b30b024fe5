#pragma once

#include <optional>

#include "suspension_health_monitor/internal/health/parameter_trend.h"
#include "suspension_health_monitor/internal/health/strut_change.h"

namespace suspension_health_monitor {

/// One parameter of the strut, followed by the trends of LS and of LA at once. LS lags a change by one memory of the
/// estimator, LA by about three (doc/uncertainty.md: its slope rho), but outliers hardly touch it. Of their two trends
/// the one counts that knows the parameter better. Estimators that never forget, or do not know their standard
/// deviations, have no trend: LA as it is counts. Cost per update: O(1), no allocation.
class FollowedParameter {
 public:
  /// @param memory  of the estimators, in updates; infinite: they never forget.  @param horizon  of their filter, in
  /// updates.
  FollowedParameter(double memory, double horizon);

  /// From the next values on, for estimators that forget by another factor for the time being.
  /// @param memory, horizon  as in the constructor; finite.
  void setMemory(double memory, double horizon);

  /// @return variance of the mean of many changes of a healthy strut, so many updates apart, over that of uncorrelated
  /// ones, where LA's trend counts, the longer one; 1 for estimators that never forget.
  static double varianceOfMeans(double memory, double horizon, double updates);

  /// @param ls  empty: not valid.
  void follow(const std::optional<UncertainValue>& ls, const UncertainValue& la);

  /// @param healthy  value and standard deviation of the healthy strut.
  /// @param certain  standard deviations from which a change is certain: of two that are, the larger one counts.
  /// @return the change from it; empty before the first estimate, or while the parameter is not above 0.
  std::optional<LogChange> changeFrom(const UncertainValue& healthy, double certain) const;

 private:
  bool forgets_;
  ParameterTrend ls_, la_;
  std::optional<UncertainValue> newest_;  // of LA
};

}  // namespace suspension_health_monitor
