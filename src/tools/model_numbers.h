#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// @return damping_to_mass and stiffness_to_mass by name.
nlohmann::json parametersOf(const StrutModel& model);

/// Adds "coefficients" and "shapes" by name.
void addNumbers(const StrutModel& model, nlohmann::json& into);

}  // namespace suspension_health_monitor
