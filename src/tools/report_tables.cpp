#include "report_tables.h"

#include <string>
#include <vector>

#include "model_numbers.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

json number(double value, const Eigen::VectorXd& stddevs, Eigen::Index i) {
  json result{{"value", value}};
  if (i < stddevs.size()) result["stddev"] = stddevs[i];
  return result;
}

json row(const std::string& symbol, const std::string& title, const std::string& unit) {
  return {{"symbol", symbol}, {"title", title}, {"unit", unit}};
}

/// Every number of a model in the order of its standard deviations: its row, without values.
json rowsOf(const StrutModel& model) {
  json rows = json::array({row("b₁", "damping / mass", "1/s"), row("b₀", "stiffness / mass", "1/s^2")});
  visit(
      model,
      [&](const std::string& name, double, const std::string& unit) { rows.push_back(row("c", "of " + name, unit)); },
      [&](const std::string& name, const ShapeParameter& shape, double) {
        rows.push_back(row(shape.name, "of " + name, shape.unit));
      });
  return rows;
}

std::vector<double> valuesOf(const StrutModel& model) {
  std::vector<double> values{model.damping_to_mass, model.stiffness_to_mass};
  visit(
      model, [&](const std::string&, double value, const std::string&) { values.push_back(value); },
      [&](const std::string&, const ShapeParameter&, double value) { values.push_back(value); });
  return values;
}

/// Puts a model's numbers under `when` into the rows of the same symbol and title.
void fill(json& rows, const char* when, const StrutModel& model, const Eigen::VectorXd& stddevs) {
  const std::vector<double> values = valuesOf(model);
  const json own = rowsOf(model);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (json& line : rows)
      if (line["symbol"] == own[i]["symbol"] && line["title"] == own[i]["title"])
        line[when] = number(values[i], stddevs, static_cast<Eigen::Index>(i));
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
  const bool extended = content.after != nullptr && content.search.final_fit;
  json rows = rowsOf(extended ? content.search.final_fit->model : before.model);
  fill(rows, "before", before.model, before.stddev);
  if (extended) fill(rows, "after", content.search.final_fit->model, content.search.final_fit->stddev);
  return rows;
}

}  // namespace suspension_health_monitor
