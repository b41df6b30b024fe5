#include <algorithm>

#include "command.h"
#include "report_page.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/text.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {

using nlohmann::json;

static void to_json(json& into, const PartialResidualBin& bin) {
  into = {{"at", bin.at}, {"mean", bin.mean}, {"deviation", bin.deviation}, {"law", bin.law}, {"count", bin.count}};
}

namespace {

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

constexpr int kLawPoints = 240;

json axisOf(ForceVariable variable) {
  switch (variable) {
    case ForceVariable::kTravel: return {{"title", "travel"}, {"unit", "m"}};
    case ForceVariable::kTravelRate: return {{"title", "travel rate"}, {"unit", "m/s"}};
    case ForceVariable::kTime: break;
  }
  return {{"title", "time"}, {"unit", "s"}};
}

/// The law over the range that was seen.  @pre force.lawAt() may be called.
json curveOf(const PartialResidual& force) {
  json at = json::array(), law = json::array();
  if (force.curve.size() > 1)
    for (int i = 0; i <= kLawPoints; ++i) {
      const double first = force.curve.front().at, last = force.curve.back().at;
      at.push_back(first + (last - first) * i / kLawPoints);
      law.push_back(force.lawAt(at.back()));
    }
  return {{"at", at}, {"law", law}};
}

json forceJson(const PartialResidual& force) {
  json result{{"effect", force.effect.effect.name}, {"law", force.effect.effect.law}, {"axes", json::array()}};
  for (const ForceVariable variable : force.variables) result["axes"].push_back(axisOf(variable));
  if (force.variables.size() == 2)
    result.update(
        {{"edges", json::array({force.grid.first_edges, force.grid.second_edges})}, {"cells", force.grid.cells}});
  else if (force.hasMemory())
    result["branches"] =
        json::array({{{"name", "compressing"}, {"bins", force.curve}}, {{"name", "extending"}, {"bins", force.back}}});
  else
    result.update({{"branches", json::array({{{"name", ""}, {"bins", force.curve}}})}, {"curve", curveOf(force)}});
  return result;
}

/// The request of ~set_effects.
std::string settingOf(const StrutModel& model) {
  std::vector<std::string> names, shape_names, shape_values;
  for (const ActiveEffect& active : model.effects) {
    names.push_back(active.effect.name);
    for (std::size_t i = 0; i < active.shapes.size(); ++i) {
      shape_names.push_back(active.effect.name + "/" + active.effect.shapes[i].name);
      shape_values.push_back(formatted("%.6g", active.shapes[i]));
    }
  }
  return "{names: [" + join(names) + "], shape_names: [" + join(shape_names) + "], shape_values: [" +
         join(shape_values) + "]}";
}

}  // namespace

json effectsJson(const EffectLibrary& library) {
  json effects = json::object();
  const auto add = [&](const auto& effect, const char* kind, const json& numbers) {
    effects[effect.name] = {{"law", effect.law},
                            {"finding", effect.finding},
                            {"advice", effect.advice},
                            {"numbers", numbers},
                            {"kind", kind}};
  };
  for (const ForceEffect& effect : library.forces) {
    json numbers = json::array({{{"key", effect.name}, {"symbol", "c"}, {"unit", effect.unit}}});
    for (const ShapeParameter& shape : effect.shapes)
      numbers.push_back({{"key", effect.name + '/' + shape.name}, {"symbol", shape.name}, {"unit", shape.unit}});
    add(effect, "force", numbers);
  }
  for (const MeasurementEffect& effect : library.readings) {
    json numbers = json::array();
    for (std::size_t i = 0; i < effect.coefficients.size(); ++i)
      numbers.push_back({{"key", nameOfCoefficient(effect, i)},
                         {"symbol", effect.coefficients.size() == 1 ? "c" : effect.coefficients[i].name},
                         {"unit", effect.coefficients[i].unit}});
    add(effect, "reading", numbers);
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

json forcesJson(const ReportContent& content) {
  json forces = json::array();
  if (content.after == nullptr) return forces;
  const std::vector<std::string>& added = content.found.selected;
  for (const PartialResidual& force : content.after->forces)
    if (std::find(added.begin(), added.end(), force.effect.effect.name) != added.end())
      forces.push_back(forceJson(force));
  return forces;
}

json addingJson(const ReportContent& content) {
  const InVehicle* vehicle = content.vehicle;
  std::string bags;
  for (const std::string& name : content.source.drive_names) bags += " " + shellQuoted(name);
  const std::string tool = "rosrun suspension_health_monitor suspension_bag ";
  const std::string of = vehicle ? " --vehicle " + shellQuoted(vehicle->file) + " --strut " + vehicle->strut : "";
  const std::string file = vehicle ? vehicle->strut + ".yaml" : "model.yaml";
  const std::string node = vehicle ? '/' + vehicle->strut : "/monitor";
  json commands = json::array();
  const auto add = [&](const char* title, const std::string& text) {
    commands.push_back({{"title", title}, {"text", text}});
  };
  add("Write the file", tool + "diagnose" + bags + of + " -o " + file);
  add("Judge the model on another drive", tool + "compare another_drive.bag" + of + " --model " + file);
  const StrutModel& model = content.found.model();
  if (!model.effects.empty())
    add("Live: add it to a running monitor and watch the error fall",
        "rosservice call " + node + "/set_effects \"" + settingOf(model) + "\"\nrqt_plot " + node +
            "/comparison/base_rmse " + node + "/comparison/rmse");
  const std::string launch = "roslaunch suspension_health_monitor ";
  if (vehicle)
    add("Live from the start, with models of all struts",
        tool + "diagnose" + bags + " --vehicle " + shellQuoted(vehicle->file) + " -o models.yaml\n" + launch +
            "vehicle.launch vehicle:=/path/to/my_vehicle.yaml model_file:=$PWD/models.yaml");
  else
    add("Live from the start", launch + "monitor.launch config:=$PWD/my_strut.yaml model_file:=$PWD/" + file);
  return {{"model_file", toYaml(model)}, {"commands", commands}};
}

}  // namespace suspension_health_monitor
