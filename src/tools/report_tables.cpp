#include "report_tables.h"

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

/// Those of the effects and of the reading, which only the extended model has.
void addEffects(const ModelFit& fit, json& rows) {
  Eigen::Index i = 2;
  const auto add = [&](json line, double value) {
    line["after"] = number(value, fit.stddev, i++);
    rows.push_back(std::move(line));
  };
  for (const ActiveEffect& active : fit.model.effects) {
    add(row("c", "of " + active.effect.name, active.effect.unit), active.coefficient);
    for (std::size_t k = 0; k < active.shapes.size(); ++k)
      add(row(active.effect.shapes[k].name, "of " + active.effect.name, active.effect.shapes[k].unit), active.shapes[k]);
  }
  for (const ActiveMeasurementEffect& active : fit.model.reading)
    add(row("c", "of " + active.effect.name, active.effect.unit), active.coefficient);
}

}  // namespace

json effectsJson(const EffectLibrary& library) {
  json effects = json::object();
  for (const ForceEffect& effect : library.forces) {
    json shapes = json::array();
    for (const ShapeParameter& shape : effect.shapes) shapes.push_back({{"name", shape.name}, {"unit", shape.unit}});
    effects[effect.name] = {{"law", effect.law}, {"unit", effect.unit}, {"finding", effect.finding},
                            {"shapes", shapes},  {"kind", "force"}};
  }
  for (const MeasurementEffect& effect : library.readings)
    effects[effect.name] = {{"law", effect.law},          {"unit", effect.unit},  {"finding", effect.finding},
                            {"shapes", json::array()}, {"kind", "reading"}};
  return effects;
}

json parametersJson(const ReportContent& content) {
  const Comparison& before = content.before;
  json damping = row("b₁", "damping / mass", "1/s"), stiffness = row("b₀", "stiffness / mass", "1/s^2");
  damping.update({{"relative", true}, {"before", number(before.model.damping_to_mass, before.stddev, 0)}});
  stiffness.update({{"relative", true}, {"before", number(before.model.stiffness_to_mass, before.stddev, 1)}});
  if (content.after == nullptr || !content.search.final_fit) return json::array({damping, stiffness});
  const ModelFit& fit = *content.search.final_fit;
  damping["after"] = number(fit.model.damping_to_mass, fit.stddev, 0);
  stiffness["after"] = number(fit.model.stiffness_to_mass, fit.stddev, 1);
  json rows = json::array({damping, stiffness});
  addEffects(fit, rows);
  return rows;
}

}  // namespace suspension_health_monitor
