#pragma once

#include "suspension_health_monitor/internal/fit/hold_out.h"

namespace suspension_health_monitor {

/// How far a residual wanders more slowly than the strut moves [m/s^2, rms]. Any strut passes what is slow as it is, so
/// that no law of one leaves this: it is a reading that wanders, as that of a body that leans does, or of a sensor that
/// drifts. It is what the means over neighbouring windows of a natural period have in common; noise has nothing.
/// @param natural_period  [samples].
double wandering(const Residuals& residuals, double natural_period);

/// @return true if a fault of the reading makes an offset above all, and that is not larger than what wanders beside
/// it: then it is no constant, and no fault of a sensor.
bool isWanderingOffset(const Residuals& before, const Residuals& after, double natural_period);

}  // namespace suspension_health_monitor
