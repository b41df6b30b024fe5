#pragma once

#include <vector>

#include "suspension_health_monitor/model/effect.h"
#include "suspension_health_monitor/model/measurement_effect.h"

namespace suspension_health_monitor {

/// What may be missing from a model, and what one may be made of: the catalogue's records and the user's own laws.
struct EffectLibrary {
  std::vector<ForceEffect> forces;
  std::vector<MeasurementEffect> readings;
};

/// @return the whole catalogue.
EffectLibrary builtInEffects();

}  // namespace suspension_health_monitor
