#include "suspension_health_monitor/internal/model/model_settings.h"

#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "suspension_health_monitor/internal/plain_text.h"
#include "suspension_health_monitor/internal/setting_groups.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

constexpr OptionField<StrutModel> kModelFields[] = {
    {"complete", "", "false: it leaves more than noise", &StrutModel::is_complete}};

double takeParameter(OptionMap& values, const std::string& name, double min) {
  const auto found = values.find(name);
  if (found == values.end())
    throw std::invalid_argument(name + " is missing; a model has damping_to_mass [1/s] and stiffness_to_mass [1/s^2]");
  const double value = toNumber(name, found->second, min, 1e15);
  values.erase(found);
  return value;
}

/// The shortest text that is exactly this number.
std::string exact(double value) {
  for (int digits = std::numeric_limits<double>::digits10;; ++digits) {
    const std::string text = formatted("%.*g", digits, value);
    if (digits == std::numeric_limits<double>::max_digits10 || std::strtod(text.c_str(), nullptr) == value) return text;
  }
}

std::string line(const char* indent, const std::string& name, double value, const std::string& unit) {
  return indent + name + ": " + exact(value) + "  # [" + unit + "]\n";
}

}  // namespace

void requireAllowed(const std::string& name, const ShapeParameter& shape, double value) {
  const bool is_plain = shape.scale == ShapeScale::kNone;
  requireIn(name, value, shape.unit, is_plain ? shape.min : 1e-9, is_plain ? shape.max : 1e9);
}

StrutModel takeModel(OptionMap& values, const EffectLibrary& library) {
  StrutModel model;
  // What a fit leaves to the linear damping may be less than nothing where an effect damps.
  model.damping_to_mass = takeParameter(values, "damping_to_mass", -1e15);
  model.stiffness_to_mass = takeParameter(values, "stiffness_to_mass", 1e-15);
  model.effects = takeEffects(values, library.forces, library.readings);
  model.reading = takeReadings(values, library.readings);
  takeOptions(values, kModelFields, model);
  if (model.effects.size() > kMostEffects)
    throw std::invalid_argument("effects: " + std::to_string(model.effects.size()) + " of them, must be at most " +
                                std::to_string(kMostEffects));
  return model;
}

std::string toYaml(const StrutModel& model) {
  std::string text = line("", "damping_to_mass", model.damping_to_mass, "1/s") +
                     line("", "stiffness_to_mass", model.stiffness_to_mass, "1/s^2");
  if (!model.is_complete) text += "complete: false  # it leaves more than noise: b1 and b0 are no nominal values\n";
  if (!model.effects.empty()) text += "effects:\n";
  for (const ActiveEffect& active : model.effects) {
    text += "  " + active.effect.name + ":\n" + line("    ", "coefficient", active.coefficient, active.effect.unit);
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      text += line("    ", active.effect.shapes[i].name, active.shapes[i], active.effect.shapes[i].unit);
  }
  if (!model.reading.empty()) text += "readings:\n";
  for (const ActiveMeasurementEffect& active : model.reading) {
    text += "  " + active.effect.name + ":\n";
    for (std::size_t i = 0; i < active.coefficients.size(); ++i)
      text +=
          line("    ", active.effect.coefficients[i].name, active.coefficients[i], active.effect.coefficients[i].unit);
  }
  return text;
}

}  // namespace suspension_health_monitor
