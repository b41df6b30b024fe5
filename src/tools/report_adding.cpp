#include <string>

#include "command.h"
#include "report_parts.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

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
