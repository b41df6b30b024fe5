#include <vector>

#include "report_parts.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

/// The row of one number, without values.
json rowOf(const ModelNumber& number) {
  if (number.symbol == "b1") return {{"symbol", "b₁"}, {"title", "damping / mass"}, {"unit", number.unit}};
  if (number.symbol == "b0") return {{"symbol", "b₀"}, {"title", "stiffness / mass"}, {"unit", number.unit}};
  const bool is_shape = number.kind == ModelNumber::Kind::kShape;
  return {
      {"symbol", number.symbol}, {"title", "of " + (is_shape ? number.effect : number.name)}, {"unit", number.unit}};
}

/// A model's numbers by name.
json valuesOf(const StrutModel& model, const std::vector<double>& stddevs) {
  json values;
  auto stddev = stddevs.begin();
  for (const ModelNumber& number : numbersOf(model)) {
    values[number.name] = {{"value", number.value}};
    if (stddev != stddevs.end()) values[number.name]["stddev"] = *stddev++;
  }
  return values;
}

}  // namespace

json effectsJson(const EffectLibrary& library) {
  json effects = json::object();
  for (const ForceEffect& effect : library.forces) {
    json numbers = json::array({{{"key", effect.name}, {"symbol", "c"}, {"unit", effect.unit}}});
    for (const ShapeParameter& shape : effect.shapes)
      numbers.push_back({{"key", effect.name + '/' + shape.name}, {"symbol", shape.name}, {"unit", shape.unit}});
    effects[effect.name] = {{"law", effect.law},
                            {"finding", effect.finding},
                            {"advice", adviceOn(effect.name)},
                            {"numbers", numbers},
                            {"kind", "force"}};
  }
  for (const MeasurementEffect& effect : library.readings) {
    json numbers = json::array();
    for (std::size_t i = 0; i < effect.coefficients.size(); ++i)
      numbers.push_back({{"key", nameOfCoefficient(effect, i)},
                         {"symbol", effect.coefficients.size() == 1 ? "c" : effect.coefficients[i].name},
                         {"unit", effect.coefficients[i].unit}});
    effects[effect.name] = {{"law", effect.law},
                            {"finding", effect.finding},
                            {"advice", adviceOn(effect.name)},
                            {"numbers", numbers},
                            {"kind", "reading"}};
  }
  return effects;
}

json parametersJson(const ReportContent& content) {
  json values{{"before", valuesOf(content.before.model, content.before.stddev)}};
  if (const auto& fit = content.found.final_fit) values["after"] = valuesOf(fit->model, fit->stddev);
  json rows = json::array();
  for (const ModelNumber& number : numbersOf(content.found.model())) {
    rows.push_back(rowOf(number));
    for (const auto& [when, numbers] : values.items())
      if (numbers.contains(number.name)) rows.back()[when] = numbers[number.name];
  }
  return rows;
}

}  // namespace suspension_health_monitor
