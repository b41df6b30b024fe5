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

/// What all commands begin with: the vehicle and its settings. Gaps in its bags are reported later.
struct AskedWork {
  ToolsWork tools;
  po::variables_map values;
  AskedVehicle vehicle;
  VehicleOptions settings;
  TopicGaps gaps;

  AskedWork(const Arguments& arguments, LongWork& work)
      : tools(work, 0),
        values(parsed(arguments)),
        vehicle(readVehicle(values)),
        settings(VehicleOptions::fromValues(vehicle.layout, gatherOptions(values))),
        gaps(settings.common.shell.input_timeout) {}

  std::vector<VehicleDrive> readDrives() {
    std::vector<VehicleDrive> drives;
    const ImuBags bags = readBags(values, settings.common.shell);
    for (VehicleBag& bag : readVehicleDrives(bags, settings.common, vehicle.layout, gaps))
      drives.push_back(std::move(bag.drive));
    return drives;
  }

  /// @param make  makes the result of a strut, by its place.
  template <class Make>
  auto byStrut(const Make& make) const {
    std::map<std::string, decltype(make(0))> results;
    for (const std::size_t i : vehicle.asked) results.emplace(vehicle.names[i], make(i));
    return results;
  }
};

auto identifyStrutsOf(const Arguments& arguments, LongWork& work) {
  AskedWork asked(arguments, work);
  std::vector<Course> courses(asked.vehicle.names.size());
  WatchedVehicle recorded(asked.values, asked.vehicle, asked.settings, plainStruts(courses.size()), {},
                          [&](std::size_t strut, const MonitorReport& report) {
                            courses[strut].add(report);
                            asked.tools.step();
                          });
  recorded.requirePeriod();
  recorded.read();
  const VehicleIdentification found = recorded.identified();
  return asked.byStrut([&](std::size_t i) {
    Identification result;
    static_cast<IdentifyResult&>(result) = found.struts[i];
    result.mean_period = std::nan("");  // of the sensors' grid, not of one strut
    result.alignment = recorded.alignment();
    const PipelineOptions& options = asked.settings.struts[i];
    result.sprung_mass = options.monitor.sprung_mass;
    result.change = describeChange(result, knownHealthy({}, options), options.monitor);
    result.course = courses[i];
    return result;
  });
}

auto compareStrutsOf(const Arguments& arguments, LongWork& work) {
  AskedWork asked(arguments, work);
  const std::vector<VehicleDrive> drives = asked.readDrives();
  const KnownModels models = readModels(asked.values, asked.vehicle, readEffects(asked.values));
  const double period = *asked.settings.common.monitor.sample_period;
  const SeparatedVehicle separated = separateVehicle(drives, asked.vehicle.names, period, models);
  asked.gaps.explain([&] { requireCoupling(separated.coupling); });
  double done = 0.0;
  return asked.byStrut([&](std::size_t i) {
    CompareOptions options = compareOptionsOf(asked.settings.struts[i], period, models[i]);
    const auto all = static_cast<double>(asked.vehicle.asked.size());
    options.progress = [&](double share) { work.update((done + share) / all); };
    Comparison comparison = compare(separated.struts[i], options);
    requireEnough(comparison.shortcoming, comparison.reason);
    ++done;
    return comparison;
  });
}

auto diagnoseStrutsOf(const Arguments& arguments, int threads, LongWork& work) {
  AskedWork asked(arguments, work);
  const std::vector<VehicleDrive> drives = asked.readDrives();
  const std::vector<std::string>& names = asked.vehicle.names;
  DiagnoseOptions options;
  options.candidates = readEffects(asked.values);
  options.threads = threads;
  options.progress = work.callback();
  const KnownModels models = readModels(asked.values, asked.vehicle, options.candidates);
  const VehicleDiagnosis found = diagnoseVehicle(drives, names, diagnoseOptionsOf(asked.settings, options), models);
  asked.gaps.explain([&] { requireCoupling(found.coupling); });
  const std::vector<std::string> changes = changesOf(drives, names, asked.settings);
  return asked.byStrut([&](std::size_t i) {
    SearchedStrut result{found.struts[i], changes[i]};
    if (!result) throw TooLittleError(names[i] + ": the drives " + result.reason);
    result.verdict = found.verdictOn(i);
    result.selected = found.selected(i);
    return result;
  });
}

auto watchStrutsOf(const Arguments& arguments, LongWork& work) {
  AskedWork asked(arguments, work);
  std::vector<Course> courses(asked.vehicle.names.size());
  WatchedVehicle recorded(asked.values, asked.vehicle, asked.settings,
                          readWatched(asked.values, asked.vehicle, asked.settings), {},
                          [&](std::size_t strut, const MonitorReport& report) {
                            courses[strut].add(report);
                            asked.tools.step();
                          });
  recorded.read();
  recorded.requireCoupling();
  return asked.byStrut([&](std::size_t i) {
    return HealthSummary::of(recorded.log(i), *recorded.monitor().strut(i), recorded.baselineFile(i),
                             recorded.rejected(), courses[i]);
  });
}

}  // namespace

void bindVehicles(pybind11::module& module) {
  defCommand<Arguments>(module, "identify_struts", &identifyStrutsOf, "arguments");
  defCommand<Arguments>(module, "compare_struts", &compareStrutsOf, "arguments");
  defCommand<Arguments>(module, "health_struts", &watchStrutsOf, "arguments");
  defCommand<Arguments, int>(module, "diagnose_struts", &diagnoseStrutsOf, "arguments", "threads");
}

}  // namespace suspension_health_monitor
