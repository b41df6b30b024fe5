#include "model_numbers.h"

namespace suspension_health_monitor {

using nlohmann::json;

json parametersOf(const StrutModel& model) {
  return {{"damping_to_mass", model.damping_to_mass}, {"stiffness_to_mass", model.stiffness_to_mass}};
}

void addNumbers(const StrutModel& model, json& into) {
  json coefficients = json::object(), shapes = json::object();
  for (const ModelNumber& number : numbersOf(model)) {
    if (number.kind == ModelNumber::Kind::kCoefficient) coefficients[number.name] = number.value;
    if (number.kind == ModelNumber::Kind::kShape) shapes[number.name] = number.value;
  }
  into["coefficients"] = coefficients;
  into["shapes"] = shapes;
}

}  // namespace suspension_health_monitor
