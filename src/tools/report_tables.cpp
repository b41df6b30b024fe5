#include "report_tables.h"

#include <string>
#include <vector>

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

/// Puts a model's numbers under `when` into the rows of the same symbol and title.
void fill(json& rows, const char* when, const StrutModel& model, const std::vector<double>& stddevs) {
  const std::vector<ModelNumber> numbers = numbersOf(model);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const json own = rowOf(numbers[i]);
    for (json& line : rows)
      if (line["symbol"] == own["symbol"] && line["title"] == own["title"]) {
        line[when] = {{"value", numbers[i].value}};
        if (i < stddevs.size()) line[when]["stddev"] = stddevs[i];
      }
  }
}

}  // namespace

json effectsJson(const EffectLibrary& library) {
  json effects = json::object();
  for (const ForceEffect& effect : library.forces) {
    json numbers = json::array({{{"key", effect.name}, {"symbol", "c"}, {"unit", effect.unit}}});
    for (const ShapeParameter& shape : effect.shapes)
      numbers.push_back({{"key", effect.name + '/' + shape.name}, {"symbol", shape.name}, {"unit", shape.unit}});
    effects[effect.name] = {{"law", effect.law}, {"finding", effect.finding}, {"numbers", numbers}, {"kind", "force"}};
  }
  for (const MeasurementEffect& effect : library.readings) {
    json numbers = json::array();
    for (std::size_t i = 0; i < effect.coefficients.size(); ++i)
      numbers.push_back({{"key", nameOfCoefficient(effect, i)},
                         {"symbol", effect.coefficients.size() == 1 ? "c" : effect.coefficients[i].name},
                         {"unit", effect.coefficients[i].unit}});
    effects[effect.name] = {
        {"law", effect.law}, {"finding", effect.finding}, {"numbers", numbers}, {"kind", "reading"}};
  }
  return effects;
}

json parametersJson(const ReportContent& content) {
  const Comparison& before = content.before;
  json rows = json::array();
  for (const ModelNumber& number : numbersOf(content.found.model())) rows.push_back(rowOf(number));
  fill(rows, "before", before.model, before.stddev);
  if (content.found.final_fit) fill(rows, "after", content.found.final_fit->model, content.found.final_fit->stddev);
  return rows;
}

}  // namespace suspension_health_monitor
