#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "suspension_health_monitor/model/strut_model.h"

namespace suspension_health_monitor {

/// Calls take(name, coefficient, unit) for every effect and fault of the reading of a model, and
/// shape(name, description, value) for every shape of it (a fault with several coefficients has one name for each, such
/// as mount_tilt/c_x): the order in which ModelFit has standard deviations.
template <class TakeCoefficient, class TakeShape>
void visit(const StrutModel& model, const TakeCoefficient& take, const TakeShape& shape) {
  for (const ActiveEffect& active : model.effects) {
    take(active.effect.name, active.coefficient, active.effect.unit);
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      shape(active.effect.name, active.effect.shapes[i], active.shapes[i]);
  }
  for (const ActiveMeasurementEffect& reading : model.reading) {
    const auto& known = reading.effect.coefficients;
    for (std::size_t i = 0; i < known.size(); ++i)
      take(nameOfCoefficient(reading.effect, i), reading.coefficients[i], known[i].unit);
  }
}

/// @return damping_to_mass and stiffness_to_mass by name.
nlohmann::json parametersOf(const StrutModel& model);

/// Adds "coefficients" and "shapes" by name.
void addNumbers(const StrutModel& model, nlohmann::json& into);

}  // namespace suspension_health_monitor
