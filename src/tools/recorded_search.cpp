#include "recorded_search.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "command.h"

namespace suspension_health_monitor {
namespace {

/// @return L, if the settings of a strut give the horizon.
std::optional<int> givenHorizon(const BagOptions& options, std::size_t strut) {
  const MonitorOptions& settings = options.settings.struts[strut].monitor;
  if (!settings.integration_horizon) return std::nullopt;
  return MonitorSettings(settings).horizonSamples(options.period());
}

VehicleDiagnosis searched(const AskedDrives& asked, const DiagnoseOptions& searching) {
  const AskedVehicle& vehicle = asked.options.vehicle;
  std::vector<DiagnoseOptions> by_strut(vehicle.names.size(), searching);
  for (std::size_t i = 0; i < by_strut.size(); ++i) {
    by_strut[i].horizon_samples = givenHorizon(asked.options, i);
    by_strut[i].model = asked.models[i];
  }
  return diagnoseVehicle(asked.drives, vehicle.names, by_strut, asked.models);
}

void requireCoupling(const VehicleCoupling& coupling) {
  if (!coupling) throw TooLittleError("the drives " + coupling.reason);
}

void requireOne(const VehicleDiagnosis& found, const AskedVehicle& vehicle) {
  requireCoupling(found.coupling);
  for (const std::size_t i : vehicle.asked)
    if (found.struts[i]) return;
  const std::size_t first = vehicle.asked.front();
  requireEnough(found.struts[first].shortcoming, found.struts[first].reason, vehicle.prefix(first, ": "));
}

}  // namespace

void requireEnough(Shortcoming shortcoming, const std::string& reason, const std::string& prefix) {
  if (shortcoming == Shortcoming::kModelUntestable) throw InputError(prefix + "the drives " + reason);
  if (shortcoming != Shortcoming::kNone) throw TooLittleError(prefix + "the drives " + reason);
}

AskedDrives::AskedDrives(const boost::program_options::variables_map& values)
    : library(readEffects(values)),
      models(readModels(values, readVehicle(values), library)),
      options(readBagOptions(values)),
      gaps(options.settings.common.shell.input_timeout) {}

void AskedDrives::read() {
  bags = readDrives(options, gaps);
  for (VehicleBag& bag : bags) drives.push_back(std::move(bag.drive));
}

RecordedComparison compareBags(const AskedDrives& asked, const std::function<void(double)>& progress) {
  const AskedVehicle& vehicle = asked.options.vehicle;
  const SeparatedVehicle own = separateVehicle(asked.drives, vehicle.names, asked.options.period(), asked.models);
  asked.gaps.explain([&] { requireCoupling(own.coupling); });
  RecordedComparison result{own.coupling, {}};
  for (const std::size_t i : vehicle.asked) {
    CompareOptions comparing;
    comparing.sample_period = asked.options.period();
    comparing.horizon_samples = givenHorizon(asked.options, i);
    comparing.model = asked.models[i];
    comparing.fit = !asked.models[i];
    comparing.progress = [&](double share) {
      progress((static_cast<double>(result.struts.size()) + share) / static_cast<double>(vehicle.asked.size()));
    };
    result.struts.push_back(compare(own.struts[i], comparing));
    const Comparison& found = result.struts.back();
    asked.gaps.explain([&] { requireEnough(found.shortcoming, found.reason, vehicle.prefix(i, ": ")); });
  }
  return result;
}

VehicleDiagnosis diagnoseBags(const AskedDrives& asked, DiagnoseOptions& searching) {
  searching.sample_period = asked.options.period();
  searching.candidates = asked.library;
  VehicleDiagnosis found = searched(asked, searching);
  asked.gaps.explain([&] { requireOne(found, asked.options.vehicle); });
  return found;
}

std::vector<std::string> changesOf(const AskedDrives& asked) {
  const BagOptions& options = asked.options;
  const std::vector<PipelineOptions>& settings = options.settings.struts;
  const HealthyStruts known = beforehand({}, options);
  std::vector<Baseline> healthy;
  std::vector<IdentifyOptions> identifying(settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    healthy.push_back(knownHealthy(known[i], settings[i]));
    identifying[i].sample_period = options.period();
    identifying[i].horizon_samples = givenHorizon(options, i);
    identifying[i].memory = settings[i].monitor.memory;
  }
  std::vector<std::string> changes(settings.size());
  if (std::all_of(healthy.begin(), healthy.end(), [](const Baseline& strut) { return strut.isEmpty(); }))
    return changes;
  const VehicleIdentification found = identifyVehicle(asked.drives, options.vehicle.names, identifying);
  for (std::size_t i = 0; i < changes.size(); ++i)
    changes[i] = describeChange(found.struts[i], healthy[i], settings[i].monitor);
  return changes;
}

}  // namespace suspension_health_monitor
