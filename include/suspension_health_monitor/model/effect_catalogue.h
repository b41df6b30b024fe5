#pragma once

#include <string_view>
#include <vector>

#include "suspension_health_monitor/model/effect.h"

namespace suspension_health_monitor {

/// The built-in force effects, one record each in effect_catalogue.cpp: everything else (fits, settings, the simulator,
/// messages, tables) iterates over this list.
const std::vector<ForceEffect>& forceEffects();

/// @return the effect of that name in `effects`.
/// @throws std::invalid_argument  naming the unknown name and the known ones.
const ForceEffect& findEffect(const std::vector<ForceEffect>& effects, std::string_view name);

}  // namespace suspension_health_monitor
