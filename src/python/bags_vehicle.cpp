// The struts of a vehicle in bags, as the commands have them with --vehicle: a result by strut.
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../ros/vehicle_options.h"
#include "../tools/bag_options.h"
#include "../tools/command.h"
#include "../tools/recorded_vehicle.h"
#include "../tools/strut_files.h"
#include "../tools/watched_vehicle.h"
#include "bags_call.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

template <class Result>
using ByStrut = std::map<std::string, Result>;

/// The drives, read and not told of.
struct RecordedVehicle {
  AskedVehicle vehicle;
  VehicleOptions settings;
  TopicGaps gaps;
  std::vector<VehicleDrive> drives;

  explicit RecordedVehicle(const po::variables_map& values)
      : vehicle(readVehicle(values)),
        settings(VehicleOptions::fromValues(vehicle.layout, gatherOptions(values))),
        gaps(settings.common.shell.input_timeout) {
    const ImuBags bags = readBags(values, settings.common.shell);
    for (VehicleBag& bag : readVehicleDrives(bags, settings.common, vehicle.layout, gaps))
      drives.push_back(std::move(bag.drive));
  }
};

ByStrut<Identification> identifyStrutsOf(const Arguments& arguments, LongWork& work) {
  const ToolsWork tools(work, 0);
  const po::variables_map values = parsed(arguments);
  AskedVehicle vehicle = readVehicle(values);
  const VehicleOptions settings = VehicleOptions::fromValues(vehicle.layout, gatherOptions(values));
  std::vector<Course> courses(vehicle.names.size());
  WatchedVehicle recorded(values, vehicle, settings, plainStruts(vehicle.names.size()), {},
                          [&](std::size_t strut, const MonitorReport& report) {
                            if (report.has_row) courses[strut].add(report);
                            work.step();
                          });
  recorded.requirePeriod();
  recorded.read();
  const VehicleIdentification found = recorded.identified();
  ByStrut<Identification> results;
  for (const std::size_t i : vehicle.asked) {
    Identification& result = results[vehicle.names[i]];
    static_cast<IdentifyResult&>(result) = found.struts[i];
    result.mean_period = std::nan("");  // of the sensors' grid, not of one strut
    result.alignment = recorded.alignment();
    const PipelineOptions& options = settings.struts[i];
    result.sprung_mass = options.monitor.sprung_mass;
    result.change = describeChange(result, knownHealthy({}, options), options.monitor);
    result.course = courses[i];
  }
  return results;
}

ByStrut<Comparison> compareStrutsOf(const Arguments& arguments, LongWork& work) {
  const ToolsWork tools(work, 0);
  const po::variables_map values = parsed(arguments);
  RecordedVehicle recorded(values);
  const auto& [vehicle, settings, gaps, drives] = recorded;
  const KnownModels models = readModels(values, vehicle, readEffects(values));
  const double period = *settings.common.monitor.sample_period;
  const SeparatedVehicle separated = separateVehicle(drives, vehicle.names, period, models);
  gaps.explain([&, &coupling = separated.coupling] { requireCoupling(coupling); });
  ByStrut<Comparison> results;
  for (const std::size_t i : vehicle.asked) {
    CompareOptions options = compareOptionsOf(settings.struts[i], period, models[i]);
    const double done = static_cast<double>(results.size()), all = static_cast<double>(vehicle.asked.size());
    options.progress = [&](double share) { work.update((done + share) / all); };
    Comparison& comparison = results[vehicle.names[i]] = compare(separated.struts[i], options);
    requireEnough(comparison.shortcoming, comparison.reason);
  }
  return results;
}

ByStrut<SearchedStrut> diagnoseStrutsOf(const Arguments& arguments, int threads, LongWork& work) {
  const ToolsWork tools(work, 0);
  const po::variables_map values = parsed(arguments);
  RecordedVehicle recorded(values);
  const std::vector<std::string>& names = recorded.vehicle.names;
  DiagnoseOptions options;
  options.candidates = readEffects(values);
  options.threads = threads;
  options.progress = work.callback();
  const KnownModels models = readModels(values, recorded.vehicle, options.candidates);
  const VehicleDiagnosis found =
      diagnoseVehicle(recorded.drives, names, diagnoseOptionsOf(recorded.settings, options), models);
  recorded.gaps.explain([&] { requireCoupling(found.coupling); });
  const std::vector<std::string> changes = changesOf(recorded.drives, names, recorded.settings);
  ByStrut<SearchedStrut> results;
  for (const std::size_t i : recorded.vehicle.asked) {
    SearchedStrut& result = results[names[i]] = {found.struts[i], changes[i]};
    if (!result) throw TooLittleError(names[i] + ": the drives " + result.reason);
    result.verdict = found.verdictOn(i);
    result.selected = found.selected(i);
  }
  return results;
}

ByStrut<HealthSummary> watchStrutsOf(const Arguments& arguments, LongWork& work) {
  const ToolsWork tools(work, 0);
  const po::variables_map values = parsed(arguments);
  AskedVehicle vehicle = readVehicle(values);
  const VehicleOptions options = VehicleOptions::fromValues(vehicle.layout, gatherOptions(values));
  std::vector<Course> courses(vehicle.names.size());
  WatchedVehicle recorded(values, vehicle, options, readWatched(values, vehicle, options), {},
                          [&](std::size_t strut, const MonitorReport& report) {
                            if (report.has_row) courses[strut].add(report);
                          });
  recorded.read();
  recorded.requireCoupling();
  ByStrut<HealthSummary> results;
  for (const std::size_t i : vehicle.asked)
    results[vehicle.names[i]] = HealthSummary::of(recorded.log(i), *recorded.monitor().strut(i),
                                                  recorded.baselineFile(i), recorded.rejected(), courses[i]);
  return results;
}

}  // namespace

void bindVehicles(pybind11::module& module) {
  defCommand(module, "identify_struts", &identifyStrutsOf);
  defCommand(module, "compare_struts", &compareStrutsOf);
  defCommand(module, "health_struts", &watchStrutsOf);
  defWork<Arguments, int>(module, "diagnose_struts", &diagnoseStrutsOf, "arguments", "threads");
}

}  // namespace suspension_health_monitor
