#include "suspension_health_monitor/model/effect_library.h"

#include "suspension_health_monitor/model/effect_catalogue.h"

namespace suspension_health_monitor {

EffectLibrary builtInEffects() { return {forceEffects(), measurementEffects()}; }

}  // namespace suspension_health_monitor
