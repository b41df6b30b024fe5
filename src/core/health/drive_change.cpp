#include "suspension_health_monitor/internal/health/drive_change.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

bool DriveChange::isProven(double change, double stddev) {
  return std::abs(change) > kLeastChange && std::abs(std::log1p(change)) > kProven * stddev;
}

DriveChange changeOf(const StrutEstimate& now, const StrutCurves& curves, const StrutEstimate& other,
                     const StrutCurves& other_curves, double payload_range) {
  DriveChange change;
  change.strut = splitChange(changeFrom(baselineOf(other, {}), now).change, payload_range, 0.0);
  MassRatio mass;
  if (const double payload = change.strut.payload.value_or(0.0); payload != 0.0) {
    // The load's part of the standard deviation of what is left without it.
    const double of_log = std::sqrt(
        std::max(0.0, square(change.strut.stiffness_stddev) - square(change.strut.measured.stiffness->stddev)));
    mass = {1.0 + payload, (1.0 + payload) * of_log};
  }
  change.damper = changeOf(curves.damper, other_curves.damper, mass);
  change.spring = changeOf(curves.spring, other_curves.spring, mass);
  return change;
}

}  // namespace suspension_health_monitor
