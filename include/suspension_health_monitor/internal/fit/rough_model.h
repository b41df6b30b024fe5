#pragma once

#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Where fits start: b1 and b0 by least squares over the regression rows of all drives.
/// Drives without excitation give no strut, see isDampedSpring().
StrutModel roughModel(const std::vector<Drive>& drives, const IntegralFilterOptions& filter);

/// @return true if b1 > 0 and b0 > 0; not for NaN.
inline bool isDampedSpring(const StrutModel& model) {
  return model.damping_to_mass > 0.0 && model.stiffness_to_mass > 0.0;
}

}  // namespace suspension_health_monitor
