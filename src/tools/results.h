#pragma once

#include <nlohmann/json.hpp>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {

/// What a search found, for people: the verdict in a sentence, the ranked table, before and after.
void printSearch(const Diagnosis& found);

/// A comparison for people: the errors by name, where the model fails in sentences, the force that it lacks as a map.
void printComparison(const Comparison& comparison);

/// The same for programs; of a comparison with the numbers behind every view.
nlohmann::json toJson(const Diagnosis& found);
nlohmann::json toJson(const Comparison& comparison);

/// @return damping_to_mass and stiffness_to_mass by name.
nlohmann::json parametersOf(const StrutModel& model);

/// Adds "coefficients" and "shapes" by name.
void addNumbers(const StrutModel& model, nlohmann::json& into);

}  // namespace suspension_health_monitor
