#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

std::vector<ModelNumber> numbersOf(const StrutModel& model) {
  using Kind = ModelNumber::Kind;
  std::vector<ModelNumber> numbers{{Kind::kStrut, "damping_to_mass", "", "b1", "1/s", model.damping_to_mass},
                                   {Kind::kStrut, "stiffness_to_mass", "", "b0", "1/s^2", model.stiffness_to_mass}};
  for (const auto& [effect, coefficient, shapes] : model.effects) {
    numbers.push_back({Kind::kCoefficient, effect.name, effect.name, "c", effect.unit, coefficient});
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const ShapeParameter& shape = effect.shapes[i];
      numbers.push_back({Kind::kShape, effect.name + '/' + shape.name, effect.name, shape.name, shape.unit, shapes[i]});
    }
  }
  for (const auto& [effect, coefficients] : model.reading)
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      numbers.push_back({Kind::kCoefficient, nameOfCoefficient(effect, i), effect.name, "c",
                         effect.coefficients[i].unit, coefficients[i]});
  return numbers;
}

std::vector<double*> valuesOf(StrutModel& model) {
  std::vector<double*> values{&model.damping_to_mass, &model.stiffness_to_mass};
  for (ActiveEffect& active : model.effects) {
    values.push_back(&active.coefficient);
    for (double& shape : active.shapes) values.push_back(&shape);
  }
  for (ActiveMeasurementEffect& reading : model.reading)
    for (double& coefficient : reading.coefficients) values.push_back(&coefficient);
  return values;
}

}  // namespace suspension_health_monitor
