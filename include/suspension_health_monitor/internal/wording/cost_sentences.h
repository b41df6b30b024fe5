#pragma once

#include <string>

#include "suspension_health_monitor/internal/search/effect_cost.h"

namespace suspension_health_monitor {

/// What an effect does to b1 and b0 in a sentence; of a harmless fault of a sensor also that there is nothing to do.
std::string describe(const EffectCost& cost);

}  // namespace suspension_health_monitor
