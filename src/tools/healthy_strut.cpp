#include <algorithm>

#include "../ros/live_baseline.h"
#include "../ros/yaml_settings.h"
#include "command.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

/// A baseline file has no nominal values, in no group.
bool areSettings(const OptionMap& values) {
  return std::any_of(values.begin(), values.end(), [](const auto& value) {
    const std::size_t place = value.first.find("nominal/");
    return place == 0 || (place != std::string::npos && value.first[place - 1] == '/');
  });
}

/// @return by strut what the file of --baseline has of it; nothing where it has nothing.
std::vector<std::optional<Baseline>> readHealthyStruts(const std::string& path, const AskedVehicle& vehicle) {
  const OptionMap settings = readYaml(path);
  if (!areSettings(settings)) return readBaselines(path, vehicle);
  std::vector<std::optional<Baseline>> baselines;
  prefixed(path + ": ", [&] {
    for (const PipelineOptions& strut : VehicleOptions::fromValues(vehicle.layout, settings).struts)
      baselines.emplace_back(nominalOf(strut.monitor));
  });
  return baselines;
}

}  // namespace

HealthyStrut readHealthy(const std::string& path) {
  OptionMap values = readYaml(path);
  return prefixed(path + ": ", [&]() -> HealthyStrut {
    if (areSettings(values)) return {nominalOf(PipelineOptions::fromValues(values).monitor), path};
    return {takeBaseline(values), path};
  });
}

std::optional<HealthyStrut> beforehand(const std::optional<HealthyStrut>& given, const PipelineOptions& options) {
  if (given) {
    requireOneReference(given->file, options.monitor);
    return given;
  }
  const LiveBaseline live(options);
  if (!live.known()) return std::nullopt;
  return HealthyStrut{*live.known(), options.shell.baseline_file};
}

std::optional<HealthyStrut> healthyOf(const boost::program_options::variables_map& values,
                                      const PipelineOptions& options) {
  std::optional<HealthyStrut> given;
  if (values.count(kBaseline) != 0) given = readHealthy(values[kBaseline].as<std::string>());
  return beforehand(given, options);
}

std::vector<std::optional<HealthyStrut>> healthyOf(const boost::program_options::variables_map& values,
                                                   const AskedVehicle& vehicle, const VehicleOptions& options) {
  std::vector<std::optional<HealthyStrut>> healthy(vehicle.names.size());
  if (values.count(kBaseline) != 0) {
    const auto path = values[kBaseline].as<std::string>();
    const std::vector<std::optional<Baseline>> baselines = readHealthyStruts(path, vehicle);
    for (std::size_t i = 0; i < healthy.size(); ++i)
      if (baselines[i] && !baselines[i]->isEmpty()) healthy[i] = HealthyStrut{*baselines[i], path};
  }
  for (std::size_t i = 0; i < healthy.size(); ++i)
    prefixed("struts/" + vehicle.names[i] + ": ", [&] { healthy[i] = beforehand(healthy[i], options.struts[i]); });
  return healthy;
}

Baseline knownHealthy(const std::optional<HealthyStrut>& given, const PipelineOptions& options) {
  const std::optional<HealthyStrut> known = beforehand(given, options);
  return known ? known->baseline : nominalOf(options.monitor);
}

std::vector<std::string> changesOf(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                   const VehicleOptions& settings) {
  std::vector<std::string> changes(names.size());
  std::vector<Baseline> healthy;
  for (const PipelineOptions& strut : settings.struts) healthy.push_back(knownHealthy({}, strut));
  if (std::all_of(healthy.begin(), healthy.end(), [](const Baseline& strut) { return strut.isEmpty(); }))
    return changes;
  const VehicleIdentification identified = identifyVehicle(drives, names, identifyOptionsOf(settings));
  for (std::size_t i = 0; i < names.size(); ++i)
    changes[i] = describeChange(identified.struts[i], healthy[i], settings.struts[i].monitor);
  return changes;
}

}  // namespace suspension_health_monitor
