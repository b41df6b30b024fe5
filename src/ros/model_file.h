#pragma once

#include <string>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Reads a model as `suspension_bag diagnose -o` writes it (model/model_settings.h).
/// @param library  what the model may be made of.
/// @throws std::invalid_argument  naming the file and what is wrong in it.
StrutModel readModelFile(const std::string& path, const EffectLibrary& library);

/// Reads a user's own laws (model/user_effects.h).
/// @param path  empty: there are none.
/// @return the catalogue and these laws.
/// @throws std::invalid_argument  naming the file and what is wrong in it.
EffectLibrary readEffectsFile(const std::string& path);

}  // namespace suspension_health_monitor
