
#include "bindings.h"
#include "options.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

struct EffectDescription {
  std::string name, law, kind, finding;
  std::vector<std::pair<std::string, std::string>> coefficients, shapes;  ///< name and unit
};

std::vector<EffectDescription> describeEffects(const EffectLibrary& library) {
  std::vector<EffectDescription> all;
  for (const ForceEffect& effect : library.forces) {
    EffectDescription& row =
        all.emplace_back(EffectDescription{effect.name, effect.law, "force", effect.finding, {{"c", effect.unit}}, {}});
    for (const ShapeParameter& shape : effect.shapes) row.shapes.emplace_back(shape.name, shape.unit);
  }
  for (const MeasurementEffect& effect : library.readings) {
    EffectDescription& row =
        all.emplace_back(EffectDescription{effect.name, effect.law, "reading", effect.finding, {}, {}});
    for (const MeasurementEffect::Coefficient& c : effect.coefficients) row.coefficients.emplace_back(c.name, c.unit);
  }
  return all;
}

/// What `model=` takes.
py::dict settingsOf(const StrutModel& model) {
  py::dict effects, readings, settings;
  for (const ActiveEffect& active : model.effects) {
    py::dict numbers;
    numbers["coefficient"] = active.coefficient;
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      numbers[py::str(active.effect.shapes[i].name)] = active.shapes[i];
    effects[py::str(active.effect.name)] = numbers;
  }
  for (const ActiveMeasurementEffect& active : model.reading) {
    py::dict numbers;
    for (std::size_t i = 0; i < active.coefficients.size(); ++i)
      numbers[py::str(active.effect.coefficients[i].name)] = active.coefficients[i];
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
  py::class_<ModelNumber>(module, "ModelNumber", "One number of a model, in SI.")
      .def_readonly("name", &ModelNumber::name, "damping_to_mass, bump_stop (its coefficient), bump_stop/g (a shape)")
      .def_readonly("effect", &ModelNumber::effect, "whose it is; empty for those of the linear strut")
      .def_readonly("symbol", &ModelNumber::symbol)
      .def_readonly("unit", &ModelNumber::unit)
      .def_readonly("value", &ModelNumber::value);
  py::class_<StrutModel>(module, "StrutModel", "The strut as it is modelled: z'' = b1 v + b0 d + sum_j c_j f_j.")
      .def_readonly("damping_to_mass", &StrutModel::damping_to_mass, "b1 [1/s]")
      .def_readonly("stiffness_to_mass", &StrutModel::stiffness_to_mass, "b0 [1/s^2]")
      .def_property_readonly("numbers", &numbersOf, "All numbers: b1, b0, then effect by effect.")
      .def_property_readonly(
          "effects",
          [](const StrutModel& model) {
            std::vector<std::string> names;
            for (const ActiveEffect& active : model.effects) names.push_back(active.effect.name);
            for (const ActiveMeasurementEffect& active : model.reading) names.push_back(active.effect.name);
            return names;
          },
          "Names of the effects in it.")
      .def_property_readonly("settings", &settingsOf, "As a dict, which model= takes as well.")
      .def(
          "yaml", [](const StrutModel& model) { return toYaml(model); },
          "The text of a model file: for model_file, `--model` and model=.");
  module.def(
      "to_model", [](const py::object& model, const EffectLibrary& library) { return toModel(model, library); },
      py::arg("model"), py::arg("library"), "A StrutModel of one, of a dict of settings, or None.");

  py::class_<EffectLibrary>(module, "EffectLibrary", "What may be missing from a model: names, laws and findings.")
      .def(py::init(&builtInEffects), "The catalogue.")
      .def_property_readonly("effects", &describeEffects);
  py::class_<EffectDescription>(module, "Effect",
                                "A physical effect that the linear strut lacks, or a fault of a reading.")
      .def_readonly("name", &EffectDescription::name)
      .def_readonly("law", &EffectDescription::law, "the formula, coefficient c included")
      .def_readonly("kind", &EffectDescription::kind, "force, or reading: a fault of the body's IMU")
      .def_readonly("coefficients", &EffectDescription::coefficients, "(name, unit) of each")
      .def_readonly("shapes", &EffectDescription::shapes, "(name, unit) of each number inside the law")
      .def_readonly("finding", &EffectDescription::finding, "what a workshop would find");
}

}  // namespace suspension_health_monitor
