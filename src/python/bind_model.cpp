#include "../ros/model_file.h"  // of its folder a file without ROS
#include "bindings.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

/// Adds each value by the name of its shape or coefficient.
template <class Named>
void addNumbers(const std::vector<Named>& named, const std::vector<double>& values, py::dict& to) {
  for (std::size_t i = 0; i < values.size(); ++i) to[py::str(named[i].name)] = values[i];
}

/// What `model=` takes.
py::dict settingsOf(const StrutModel& model) {
  py::dict effects, readings, settings;
  for (const ActiveEffect& active : model.effects) {
    py::dict numbers;
    numbers["coefficient"] = active.coefficient;
    addNumbers(active.effect.shapes, active.shapes, numbers);
    effects[py::str(active.effect.name)] = numbers;
  }
  for (const ActiveMeasurementEffect& active : model.reading) {
    py::dict numbers;
    addNumbers(active.effect.coefficients, active.coefficients, numbers);
    readings[py::str(active.effect.name)] = numbers;
  }
  settings["damping_to_mass"] = model.damping_to_mass;
  settings["stiffness_to_mass"] = model.stiffness_to_mass;
  if (!model.effects.empty()) settings["effects"] = effects;
  if (!model.reading.empty()) settings["readings"] = readings;
  return settings;
}

}  // namespace

void bindModel(py::module& module) {
  ResultClass<ModelNumber>(module, "ModelNumber", "One number of a model, in SI.");
  ResultClass<StrutModel>(module, "StrutModel", "The strut as it is modelled: z'' = b1 v + b0 d + sum_j c_j f_j.")
      .add("numbers", &numbersOf)
      .add("effects", &effectNames)
      .add("settings", &settingsOf)
      .def("yaml", py::overload_cast<const StrutModel&>(&toYaml),
           "The text of a model file: for model_file, `--model` and model=.");
  module.def("to_model", &toModel, py::arg("settings"), py::arg("library"),
             "The StrutModel that settings are, by their full names.");

  ResultClass<EffectLibrary>(module, "EffectLibrary", "What may be missing from a model: names, laws and findings.")
      .add("effects", &EffectLibrary::describe)
      .def(py::init(&builtInEffects), "The catalogue.");
  ResultClass<EffectLibrary::Description>(module, "Effect",
                                          "A physical effect that the linear strut lacks, or a fault of a reading.");
}

}  // namespace suspension_health_monitor
