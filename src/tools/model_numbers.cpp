#include "model_numbers.h"

namespace suspension_health_monitor {

using nlohmann::json;

json parametersOf(const StrutModel& model) {
  return {{"damping_to_mass", model.damping_to_mass}, {"stiffness_to_mass", model.stiffness_to_mass}};
}

void addNumbers(const StrutModel& model, json& into) {
  json coefficients = json::object(), shapes = json::object();
  visit(
      model, [&](const std::string& name, double value, const std::string&) { coefficients[name] = value; },
      [&](const std::string& name, const ShapeParameter& shape, double value) {
        shapes[name + "/" + shape.name] = value;
      });
  into["coefficients"] = coefficients;
  into["shapes"] = shapes;
}

}  // namespace suspension_health_monitor
