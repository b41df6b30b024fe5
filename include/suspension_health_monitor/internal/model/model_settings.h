#pragma once

#include <string>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/option_table.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// A model as settings, all in SI:
///   damping_to_mass, stiffness_to_mass, effects/NAME/coefficient, effects/NAME/SHAPE, readings/NAME/COEFFICIENT.
/// Takes them out of `values`.
/// @param library  what the model may be made of.
/// @throws std::invalid_argument  naming a setting that is missing, unknown or wrong, its value, and what is allowed.
StrutModel takeModel(OptionMap& values, const EffectLibrary& library);

/// @return the same settings as a YAML document, units as comments. takeModel() gets every number back to the last bit.
std::string toYaml(const StrutModel& model);

}  // namespace suspension_health_monitor
