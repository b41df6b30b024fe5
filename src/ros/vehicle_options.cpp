#include "vehicle_options.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <utility>

#include "live_model.h"
#include "model_file.h"
#include "suspension_health_monitor/internal/base/option_table.h"
#include "yaml_settings.h"

namespace suspension_health_monitor {
namespace {

VehicleLayout takeLayout(OptionMap& values) {
  if (OptionMap sensors = takePrefixed(values, "vehicle"); !sensors.empty())
    return prefixed("vehicle: ", [&] { return takeVehicle(sensors); });
  std::string file;
  constexpr OptionTraits kFile{{}, "vehicle", "-", "YAML file that says which sensors the vehicle has", 0.0, 0.0, {}};
  if (const auto given = values.extract("vehicle")) option_table::assign({kFile, &file}, given.mapped());
  if (file.empty())
    throw std::invalid_argument(
        "vehicle is missing, must be the YAML file that says which sensors the vehicle has, or what it says");
  return prefixed("vehicle = ", [&] { return readVehicleFile(file); });
}

/// Sensors are read, aligned and kept for all struts together.
bool isOfVehicle(const std::string& name) {
  const std::vector<OptionDescription> all = PipelineOptions::describe();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const OptionDescription& option) { return option.name == name; });
  return found != all.end() && (found->group == "input" || found->name == "diagnose/window");
}

PipelineOptions optionsOf(const std::string& strut, OptionMap values, const OptionMap& own) {
  for (const auto& [name, value] : own) {
    if (isOfVehicle(name))
      throw std::invalid_argument("struts/" + strut + '/' + name + ": " + name +
                                  " is of the whole vehicle, must be given without struts/" + strut);
    values[name] = value;
  }
  return prefixed("struts/" + strut + ": ", [&] { return PipelineOptions::fromValues(values); });
}

void requireOwnFiles(const VehicleOptions& options, const char* name, std::string ShellOptions::*file) {
  std::map<std::string, std::string> users;
  for (std::size_t i = 0; i < options.struts.size(); ++i) {
    const std::string& path = options.struts[i].shell.*file;
    if (path.empty() || (file == &ShellOptions::model_file && !options.model_of[i].empty())) continue;
    const auto [other, is_first] = users.emplace(path, options.layout.struts[i].name);
    if (!is_first)
      throw std::invalid_argument(std::string(name) + " = \"" + path + "\" is the file of " + other->second +
                                  " and of " + options.layout.struts[i].name + ", must be one for each: struts/NAME/" +
                                  name);
  }
}

/// A file of all models is not to have one of a strut that is none.
void requireItsStruts(const VehicleOptions& options) {
  const ShellOptions& shell = options.common.shell;
  if (shell.model_file.empty() || !std::filesystem::exists(shell.model_file)) return;
  const std::vector<std::string> names = options.strutNames();
  prefixed("model_file = ", [&] {
    for (const auto& [name, model] : readModelsFile(shell.model_file, readEffectsFile(shell.effects_file)))
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw std::invalid_argument(shell.model_file + ": struts/" + name + ", must be one of " + join(names));
  });
}

/// What a model leaves moves b1 and b0 from drive to drive.
void dropNominalOfIncompleteModels(VehicleOptions& options) {
  for (std::size_t i = 0; i < options.struts.size(); ++i) {
    PipelineOptions& strut = options.struts[i];
    auto &damping = strut.monitor.nominal_damping_to_mass, &stiffness = strut.monitor.nominal_stiffness_to_mass;
    if (strut.shell.model_file.empty() || !(damping || stiffness)) continue;
    prefixed(options.prefix(i), [&] {
      if (!LiveModel(strut.shell, options.model_of[i]).isComplete())
        damping = stiffness = strut.monitor.nominal_friction = strut.monitor.nominal_friction_gain = std::nullopt;
    });
  }
}

}  // namespace

VehicleOptions VehicleOptions::fromValues(OptionMap values) {
  VehicleLayout layout = takeLayout(values);
  return fromValues(std::move(layout), std::move(values));
}

VehicleOptions VehicleOptions::fromValues(VehicleLayout layout, OptionMap values) {
  VehicleOptions options;
  options.layout = std::move(layout);
  std::map<std::string, OptionMap> own = takeGroups(values, "struts");
  options.common = PipelineOptions::fromValues(values);
  for (const std::string& strut : options.strutNames()) {
    options.struts.push_back(optionsOf(strut, values, own[strut]));
    const bool is_of_all = own[strut].count("model_file") == 0 && !options.common.shell.model_file.empty();
    options.model_of.push_back(is_of_all ? strut : "");
    own.erase(strut);
  }
  if (!own.empty())
    throw std::invalid_argument("struts/" + own.begin()->first + ": the vehicle has no such strut, must be one of " +
                                join(options.strutNames()));
  requireOwnFiles(options, "baseline_file", &ShellOptions::baseline_file);
  requireOwnFiles(options, "model_file", &ShellOptions::model_file);
  requireItsStruts(options);
  dropNominalOfIncompleteModels(options);
  return options;
}

VehicleOptions VehicleOptions::ofOneStrut(const PipelineOptions& options) {
  VehicleOptions one{VehicleLayout::ofOneStrut(options.monitor.tyre), options, {options}, {""}};
  dropNominalOfIncompleteModels(one);
  return one;
}

std::vector<std::string> VehicleOptions::temperatureTopics() const {
  return mapped(struts, [](const PipelineOptions& strut) { return strut.shell.temperature_topic; });
}

VehicleLayout readVehicleFile(const std::string& path) {
  OptionMap values = readYaml(path);
  return prefixed(path + ": ", [&] { return takeVehicle(values); });
}

}  // namespace suspension_health_monitor
