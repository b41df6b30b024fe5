#include "strut_files.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "../ros/live_baseline.h"
#include "../ros/model_file.h"
#include "../ros/yaml_settings.h"
#include "command.h"
#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

/// @return by name what the file has of the struts.
std::map<std::string, OptionMap> readStruts(const std::string& path, const AskedVehicle& vehicle) {
  OptionMap values = readYaml(path);
  return prefixed(path + ": ", [&] {
    std::map<std::string, OptionMap> struts = takeGroups(values, kStruts);
    if (struts.empty() && vehicle.only)
      struts[vehicle.names[*vehicle.only]] = std::move(values);
    else if (struts.empty())
      throw std::invalid_argument(
          "struts are missing, must be struts: {NAME: {...}}; the file of one strut needs --strut NAME");
    else if (!values.empty())
      throw std::invalid_argument(shortened(values.begin()->first) + " stands beside struts, must be of a strut");
    for (const auto& [name, settings] : struts)
      if (std::find(vehicle.names.begin(), vehicle.names.end(), name) == vehicle.names.end())
        throw std::invalid_argument("struts/" + shortened(name) + ", must be one of " + join(vehicle.names));
    if (vehicle.only && struts.count(vehicle.names[*vehicle.only]) == 0)
      throw std::invalid_argument("struts/" + vehicle.names[*vehicle.only] + " is missing, which --strut asks for");
    return struts;
  });
}

/// @param take  makes of a strut's settings what it is.
template <class Take>
auto readByStrut(const std::string& path, const AskedVehicle& vehicle, const Take& take) {
  std::vector<std::optional<decltype(take(std::declval<OptionMap&>()))>> taken(vehicle.names.size());
  std::map<std::string, OptionMap> struts = readStruts(path, vehicle);
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (const auto found = struts.find(vehicle.names[i]); found != struts.end())
      prefixed(path + ": " + vehicle.names[i] + ": ", [&] { taken[i] = take(found->second); });
  return taken;
}

std::string head(const std::vector<std::string>& drives, const char* load) {
  return "# By `suspension_bag identify` from " + shortened(join(drives)) + ".\n# " + load +
         "\n# nominal is what health is judged by: keep it if this strut was healthy.\n";
}

std::string ownSettings(const StrutOfDrive& found) {
  const StrutEstimate& strut = found.strut;
  std::string text =
      formatted("integration_horizon: %.6g  # [s]\nnominal:  # %s\n", found.horizon, found.by.c_str()) +
      formatted("  damping_to_mass: %.6g  # +- %.2g 1/s\n", strut.damping_to_mass, strut.damping_to_mass_stddev) +
      formatted("  stiffness_to_mass: %.6g  # +- %.2g 1/s^2\n", strut.stiffness_to_mass,
                strut.stiffness_to_mass_stddev);
  if (!strut.friction || std::abs(strut.friction->force) <= kLikely * strut.friction->stddev) return text;
  return text + formatted("  friction: %.6g  # +- %.2g m/s^2\n  friction_gain: %.6g  # [s/m], on that road\n",
                          strut.friction->force, strut.friction->stddev, strut.friction->damping_gain);
}

/// @return the settings as YAML, by group.
std::string nested(const OptionMap& settings) {
  YAML::Node groups(YAML::NodeType::Map);
  for (const auto& [name, value] : settings) {
    const auto* text = std::get_if<std::string>(&value);
    if (text == nullptr) continue;
    const std::size_t slash = name.find('/');
    if (slash == std::string::npos)
      groups[name] = *text;
    else
      groups[name.substr(0, slash)][name.substr(slash + 1)] = *text;
  }
  return groups.size() == 0 ? "" : YAML::Dump(groups) + '\n';
}

/// Without the settings that the identified ones replace.
OptionMap othersOf(OptionMap given) {
  for (const char* name : {"integration_horizon", "baseline_file"}) given.erase(name);
  takePrefixed(given, "nominal");
  return given;
}

/// @return by strut what the file of --baseline has of it; nothing where it has nothing.
std::vector<std::optional<Baseline>> readHealthyStruts(const std::string& path, const AskedVehicle& vehicle) {
  if (vehicle.isStrutAlone()) return {readHealthy(path)};
  const OptionMap settings = readYaml(path);
  if (!areSettings(settings)) return readByStrut(path, vehicle, takeBaseline);
  std::vector<std::optional<Baseline>> baselines;
  prefixed(path + ": ", [&] {
    for (const PipelineOptions& strut : VehicleOptions::fromValues(vehicle.layout, settings).struts)
      baselines.emplace_back(nominalOf(strut.monitor));
  });
  return baselines;
}

}  // namespace

KnownModels readModels(const po::variables_map& values, const AskedVehicle& vehicle, const EffectLibrary& library) {
  if (values.count(kModel) == 0) return KnownModels(vehicle.names.size());
  const auto path = values[kModel].as<std::string>();
  if (vehicle.isStrutAlone()) return {readModelFile(path, library)};
  return readByStrut(path, vehicle, [&](const OptionMap& settings) { return toModel(settings, library); });
}

std::string whyNotNominal(const IdentifyResult& found, const MonitorOptions& options) {
  const std::optional<StrutOfDrive> strut = strutOf(found);
  if (!strut) return "no estimate is valid";
  if (!found.warnings.empty()) return found.warnings.front();
  std::vector<std::string> lacks;
  const auto ask = [&](const char* name, double value, double stddev, double warn) {
    if (kProven * stddev <= warn * value) return;
    lacks.push_back(formatted("%s is known to %.2g %% only, and %.2g %% are needed for a warning at %.3g %%", name,
                              100.0 * stddev / value, 100.0 * warn / kProven, 100.0 * warn));
  };
  const StrutEstimate& its = strut->strut;
  ask("damping/mass", its.damping_to_mass, its.damping_to_mass_stddev, options.damping_warn);
  ask("stiffness/mass", its.stiffness_to_mass, its.stiffness_to_mass_stddev, options.stiffness_warn);
  return join(lacks, "; ");
}

std::string settingsOf(const std::map<std::string, StrutOfDrive>& struts, bool is_of_one, OptionMap given,
                       const std::vector<std::string>& drives) {
  std::map<std::string, OptionMap> own = takeGroups(given, kStruts);
  if (is_of_one) {
    const auto& [name, strut] = *struts.begin();
    own[name].insert(given.begin(), given.end());
    return head(drives, "For `config:=` of monitor.launch and replay.launch, and `suspension_bag ... --config`.") +
           ownSettings(strut) + nested(othersOf(own[name]));
  }
  std::string text =
      head(drives, "For `strut_config:=` of vehicle.launch, and `suspension_bag ... --vehicle ... --config`.");
  text += nested(othersOf(given)) + "struts:\n";
  for (const auto& [name, strut] : struts) {
    text += belowStrut(name, ownSettings(strut) + nested(othersOf(own[name])));
    own.erase(name);
  }
  for (const auto& [name, settings] : own) text += belowStrut(name, nested(settings));
  return text;
}

Baseline readHealthy(const std::string& path) {
  OptionMap values = readYaml(path);
  return prefixed(path + ": ", [&] {
    return areSettings(values) ? nominalOf(PipelineOptions::fromValues(values).monitor) : takeBaseline(values);
  });
}

HealthyStruts beforehand(HealthyStruts given, const BagOptions& options) {
  given.resize(options.vehicle.names.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    prefixed(options.settings.prefix(i), [&] {
      const PipelineOptions& strut = options.settings.struts[i];
      if (given[i]) return requireOneReference(given[i]->file, strut.monitor);
      if (const LiveBaseline live(strut); live.known()) given[i] = {*live.known(), strut.shell.baseline_file};
    });
  return given;
}

HealthyStruts healthyOf(const po::variables_map& values, const BagOptions& options) {
  HealthyStruts given;
  if (values.count(kBaseline) != 0) {
    const auto path = values[kBaseline].as<std::string>();
    for (const std::optional<Baseline>& healthy : readHealthyStruts(path, options.vehicle)) {
      given.emplace_back();
      if (healthy && !healthy->isEmpty()) given.back() = {*healthy, path};
    }
  }
  return beforehand(std::move(given), options);
}

Baseline knownHealthy(const std::optional<HealthyStrut>& healthy, const PipelineOptions& options) {
  return healthy ? healthy->baseline : nominalOf(options.monitor);
}

}  // namespace suspension_health_monitor
