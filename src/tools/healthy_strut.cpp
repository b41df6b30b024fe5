#include <utility>

#include "../ros/live_baseline.h"
#include "../ros/yaml_settings.h"
#include "command.h"
#include "strut_files.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

/// @return by strut what the file of --baseline has of it; nothing where it has nothing.
std::vector<std::optional<Baseline>> readHealthyStruts(const std::string& path, const AskedVehicle& vehicle) {
  if (vehicle.isStrutAlone()) return {readHealthy(path)};
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

Baseline readHealthy(const std::string& path) {
  OptionMap values = readYaml(path);
  return prefixed(path + ": ", [&] {
    return areSettings(values) ? nominalOf(PipelineOptions::fromValues(values).monitor) : takeBaseline(values);
  });
}

HealthyStruts beforehand(HealthyStruts given, const BagOptions& options) {
  given.resize(options.vehicle.names.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    prefixed(options.vehicle.prefix(i, ": ", "struts/"), [&] {
      const PipelineOptions& strut = options.settings.struts[i];
      if (given[i]) return requireOneReference(given[i]->file, strut.monitor);
      if (const LiveBaseline live(strut); live.known()) given[i] = {*live.known(), strut.shell.baseline_file};
    });
  return given;
}

HealthyStruts healthyOf(const boost::program_options::variables_map& values, const BagOptions& options) {
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
