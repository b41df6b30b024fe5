#pragma once

#include "suspension_health_monitor/internal/compare/curve_change.h"
#include "suspension_health_monitor/internal/health/health_rules.h"

namespace suspension_health_monitor {

/// A strut on one drive against the same strut on another.
struct DriveChange {
  StrutChange strut;           ///< of b1 and b0, payload taken out
  CurveChange damper, spring;  ///< of the forces, payload taken out, too

  /// @return whether b1 or b0 has changed by more than kLeastChange and kProven standard deviations.
  static bool isProven(double change, double stddev);
};

/// @param now, other  valid.  @param payload_range  as splitChange().
DriveChange changeOf(const StrutEstimate& now, const StrutCurves& curves, const StrutEstimate& other,
                     const StrutCurves& other_curves, double payload_range);

}  // namespace suspension_health_monitor
