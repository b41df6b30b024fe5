#include "suspension_health_monitor/internal/model/model_settings.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/base/text.h"

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

std::vector<EffectLibrary::Description> EffectLibrary::describe() const {
  std::vector<Description> all;
  const auto add = [&](const auto& effect, const char* kind) -> Description& {
    return all.emplace_back(Description{effect.name, effect.law, kind, effect.finding, effect.advice, {}, {}});
  };
  for (const ForceEffect& effect : forces) {
    Description& its = add(effect, "force");
    its.coefficients.emplace_back("c", effect.unit);
    for (const ShapeParameter& shape : effect.shapes) its.shapes.emplace_back(shape.name, shape.unit);
  }
  for (const MeasurementEffect& effect : readings) {
    Description& its = add(effect, "reading");
    for (const MeasurementEffect::Coefficient& c : effect.coefficients) its.coefficients.emplace_back(c.name, c.unit);
  }
  return all;
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

std::vector<std::string> effectNames(const StrutModel& model) {
  std::vector<std::string> names = mapped(model.effects, [](const ActiveEffect& active) { return active.effect.name; });
  for (const ActiveMeasurementEffect& active : model.reading) names.push_back(active.effect.name);
  return names;
}

namespace {

constexpr const char* kEffects = "effects";
constexpr const char* kReadings = "readings";
constexpr const char* kCoefficient = "coefficient";

/// @param besides  what else the message has to say.
/// @return the record of that name.  @throws std::invalid_argument  naming the unknown name and the known ones.
template <class Record>
const Record& findByName(const std::vector<Record>& records, std::string_view name, const std::string& besides = {}) {
  const auto found = std::find_if(records.begin(), records.end(), [&](const Record& r) { return r.name == name; });
  if (found != records.end()) return *found;
  const std::vector<std::string> known = namesOf(records);
  throw std::invalid_argument("effect " + std::string(name) + ", must be one of " + join(known) + besides +
                              suggestNearest(std::string(name), known));
}

std::string orFaults(const std::vector<MeasurementEffect>& faults) {
  if (faults.empty()) return "";
  return "; or a fault of the reading (" + std::string(kReadings) + "/NAME/...): " + join(namesOf(faults));
}

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

const ForceEffect& findEffect(const std::vector<ForceEffect>& effects, std::string_view name) {
  return findByName(effects, name);
}

const MeasurementEffect& findEffect(const std::vector<MeasurementEffect>& effects, std::string_view name) {
  return findByName(effects, name);
}

std::vector<ActiveEffect> takeEffects(OptionMap& values, const std::vector<ForceEffect>& catalogue,
                                      const std::vector<MeasurementEffect>& faults) {
  std::vector<ActiveEffect> result;
  for (const auto& [name, settings] : takeGroups(values, kEffects)) {
    ActiveEffect active{findByName(catalogue, name, orFaults(faults)), 0.0, {}};
    const std::string group = std::string(kEffects) + '/' + name;
    std::vector<std::string> wanted{kCoefficient};
    for (const ShapeParameter& shape : active.effect.shapes) wanted.push_back(shape.name);
    const std::vector<double> numbers = takeNumbers(group, settings, wanted);
    active.coefficient = numbers.front();
    active.shapes.assign(numbers.begin() + 1, numbers.end());
    for (std::size_t i = 0; i < active.shapes.size(); ++i)
      requireAllowed(group + '/' + wanted[i + 1], active.effect.shapes[i], active.shapes[i]);
    result.push_back(std::move(active));
  }
  return result;
}

std::vector<ActiveMeasurementEffect> takeReadings(OptionMap& values, const std::vector<MeasurementEffect>& catalogue) {
  std::vector<ActiveMeasurementEffect> result;
  for (const auto& [name, settings] : takeGroups(values, kReadings)) {
    const MeasurementEffect& effect = findEffect(catalogue, name);
    const std::string group = std::string(kReadings) + '/' + name;
    result.push_back({effect, takeNumbers(group, settings, namesOf(effect.coefficients))});
  }
  return result;
}

void setEffect(OptionMap& values, const std::string& assignment, const std::vector<MeasurementEffect>& faults) {
  const auto refuse = [&] {
    throw std::invalid_argument("--effect " + shortened(assignment) + ", must be NAME=COEFFICIENT[,SHAPE=VALUE]...");
  };
  std::istringstream parts(assignment);
  std::string part, group, first = kCoefficient;
  while (std::getline(parts, part, ',')) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == part.size()) refuse();
    const std::string name = part.substr(0, equals), value = part.substr(equals + 1);
    if (!group.empty()) {
      values[group + name] = value;
      continue;
    }
    group = std::string(kEffects) + '/' + name + '/';
    for (const MeasurementEffect& fault : faults) {
      if (fault.name != name) continue;
      group = std::string(kReadings) + '/' + name + '/';
      first = fault.coefficients.front().name;
      for (const MeasurementEffect::Coefficient& c : fault.coefficients) values[group + c.name] = 0.0;
    }
    values[group + first] = value;
  }
  if (group.empty()) refuse();
}

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
  for (const auto& [effect, coefficient, shapes] : model.effects) {
    text += "  " + effect.name + ":\n" + line("    ", kCoefficient, coefficient, effect.unit);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      text += line("    ", effect.shapes[i].name, shapes[i], effect.shapes[i].unit);
  }
  if (!model.reading.empty()) text += "readings:\n";
  for (const auto& [effect, coefficients] : model.reading) {
    text += "  " + effect.name + ":\n";
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      text += line("    ", effect.coefficients[i].name, coefficients[i], effect.coefficients[i].unit);
  }
  return text;
}

}  // namespace suspension_health_monitor
