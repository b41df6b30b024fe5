#include <string>

#include "report_parts.h"
#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
  const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./+:=,@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char character : word)
    if (character == '\'')
      result += "'\\''";
    else
      result += character;
  return result + "'";
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

json addingJson(const ReportContent& content) {
  const InVehicle* vehicle = content.vehicle;
  std::string bags;
  for (const std::string& name : content.drive_names) bags += " " + quoted(name);
  const std::string tool = "rosrun suspension_health_monitor suspension_bag ";
  const std::string of = vehicle ? " --vehicle " + quoted(vehicle->file) + " --strut " + vehicle->strut : "";
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
    add("Live from the start: name the file among what differs at this strut, my_struts.yaml",
        "struts: {" + vehicle->strut + ": {model_file: /path/to/" + file + "}}\n\n" + launch +
            "vehicle.launch vehicle:=/path/to/my_vehicle.yaml strut_config:=$PWD/my_struts.yaml");
  else
    add("Live from the start: name the file in your copy of monitor.yaml",
        "model_file: /path/to/" + file + "\n\n" + launch + "monitor.launch config:=$PWD/my_strut.yaml");
  return {{"model_file", toYaml(model)}, {"commands", commands}};
}

}  // namespace suspension_health_monitor
