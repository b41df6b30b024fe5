// What the commands do with bags, by the code of the command line: a result by strut; one alone has no name.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../tools/recorded_drives.h"
#include "../tools/recorded_monitor.h"
#include "bags_call.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;

/// @param arguments  as on the command line, of any of the commands.
po::variables_map parsed(const Arguments& arguments) {
  po::options_description description = bagOptions();
  addModelOptions(description);
  description.add_options()(kBaseline, po::value<std::string>());
  return *parse(arguments, "", description, "bag");
}

/// @param make  makes the result of a strut, by its place.
template <class Make>
auto byStrut(const BagOptions& options, const Make& make) {
  std::map<std::string, decltype(make(0))> results;
  for (const std::size_t i : options.vehicle.asked) results.emplace(options.vehicle.names[i], make(i));
  return results;
}

/// The monitor over the bags, which are read, with the course of every strut.
struct Watched {
  std::vector<Course> courses;
  RecordedMonitor recorded;

  /// @param keeps_logs  as RecordedMonitor.
  Watched(const BagOptions& options, const HealthyStruts& healthy, bool keeps_logs, ToolsWork& tools)
      : courses(healthy.size()),
        recorded(options, healthy, keeps_logs,
                 [this](std::size_t strut, const MonitorReport& report) { courses[strut].add(report); }) {
    tools.tellReading(options.bags.paths.size());
    recorded.read();
  }
};

auto identifyBags(const Arguments& arguments, LongWork& work) {
  ToolsWork tools(work, 0);
  const BagOptions options = readBagOptions(parsed(arguments));
  const HealthyStruts healthy = beforehand({}, options);
  Watched watched(options, healthy, false, tools);
  const VehicleIdentification found = watched.recorded.identified();
  return byStrut(options, [&](std::size_t i) {
    Identification result = Identification::of(found.struts[i], watched.recorded.pipeline(), i, watched.courses[i]);
    const PipelineOptions& settings = options.settings.struts[i];
    result.change = describeChange(result, knownHealthy(healthy[i], settings), settings.monitor);
    return result;
  });
}

/// @param baseline, file  of a strut alone, that are given as objects.
auto watchBags(const Arguments& arguments, const std::optional<Baseline>& baseline, const std::string& file,
               LongWork& work) {
  ToolsWork tools(work, 0);
  const po::variables_map values = parsed(arguments);
  const BagOptions options = readLiveOptions(values);
  const HealthyStruts healthy =
      baseline ? beforehand({HealthyStrut{*baseline, file}}, options) : healthyOf(values, options);
  const Watched watched(options, healthy, true, tools);
  const RecordedMonitor& recorded = watched.recorded;
  return byStrut(options, [&](std::size_t i) {
    return HealthSummary::of(recorded.log(i), recorded.strut(i), recorded.baselineFile(i),
                             recorded.pipeline().rejected(), watched.courses[i]);
  });
}

auto compareDrives(const Arguments& arguments, LongWork& work) {
  const ToolsWork tools(work, 0);
  AskedDrives asked(parsed(arguments));
  asked.read();
  RecordedComparison found = compareBags(asked, work.callback());
  auto next = found.struts.begin();
  return byStrut(asked.options, [&](std::size_t) { return std::move(*next++); });
}

auto diagnoseDrives(const Arguments& arguments, int threads, LongWork& work) {
  const ToolsWork tools(work, 0);
  AskedDrives asked(parsed(arguments));
  asked.read();
  DiagnoseOptions searching;
  searching.threads = threads;
  searching.progress = work.callback();
  const VehicleDiagnosis found = diagnoseBags(asked, searching);
  const std::vector<std::string> changes = changesOf(asked);
  return byStrut(asked.options, [&](std::size_t i) {
    SearchedStrut result{found.struts[i], changes[i]};
    requireEnough(result.shortcoming, result.reason, asked.options.vehicle.prefix(i, ": "));
    result.curves =
        strutCurves(found.drives[i], result.model(), asked.options.period(), found.coupling.modelErrorOf(i));
    result.travel = travelStatistics(found.drives[i], result.model(), asked.options.period());
    result.verdict = found.verdictOn(i);
    result.selected = found.selected(i);
    return result;
  });
}

}  // namespace

void bindBags(pybind11::module& module) {
  defCommand<Arguments>(module, "identify", &identifyBags, "arguments");
  defCommand<Arguments, std::optional<Baseline>, std::string>(module, "health", &watchBags, "arguments", "baseline",
                                                              "file");
  defCommand<Arguments>(module, "compare", &compareDrives, "arguments");
  defCommand<Arguments, int>(module, "diagnose", &diagnoseDrives, "arguments", "threads");
}

}  // namespace suspension_health_monitor
