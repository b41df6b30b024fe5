// The compiled part of the Python module that reads and writes bags and files, by the code of the command line.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <stdexcept>
#include <utility>

#include "../ros/model_file.h"
#include "../ros/simulated_drive.h"
#include "../ros/yaml_settings.h"
#include "../tools/bag_options.h"
#include "../tools/command.h"
#include "../tools/recorded_strut.h"
#include "../tools/strut_files.h"
#include "bags_call.h"
#include "options.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

namespace py = pybind11;
namespace po = boost::program_options;

Identification identifyBags(const Arguments& arguments, LongWork& work) {
  ToolsWork tools(work, 0);
  const BagOptions options = readBagOptions(parsed(arguments));
  Course course;
  RecordedMonitor recorded(options, {}, {}, [&](const MonitorReport& report) {
    if (report.has_row) course.add(report);
  });
  tools.tellReading(options.bags.paths.size());
  recorded.read();
  Identification found = Identification::of(recorded.strut(), recorded.rejected(), course);
  found.change = describeChange(found, knownHealthy({}, options.pipeline), options.pipeline.monitor);
  return found;
}

HealthSummary watchBags(const Arguments& arguments, const std::optional<HealthyStrut>& healthy, LongWork& work) {
  ToolsWork tools(work, 0);
  const BagOptions options = readLiveOptions(parsed(arguments));
  Course course;
  RecordedMonitor recorded(options, beforehand(healthy, options.pipeline), {}, [&](const MonitorReport& report) {
    if (report.has_row) course.add(report);
  });
  tools.tellReading(options.bags.paths.size());
  recorded.read();
  return HealthSummary::of(recorded.log(), recorded.monitor(), recorded.baselineFile(), recorded.rejected(), course);
}

/// Calls work(options, models, gaps) for the search and the comparison.
template <class Work>
auto withDrives(const Arguments& arguments, LongWork& progress, const Work& work) {
  const ToolsWork tools(progress, 0);
  const po::variables_map values = parsed(arguments);
  const ModelOptions models = readModelOptions(values);
  const BagOptions options = readBagOptions(values, true);
  TopicGaps gaps(options.pipeline.shell.input_timeout);
  return work(options, models, gaps);
}

std::string writeSimulation(const std::string& path, const OptionMap& values, LongWork& work) {
  const ToolsWork tools(work, 1);
  const SimulatedDrive drive = makeSimulatedDrive(values);
  const double start = drive.playing.start_time;
  writeBag(*drive.begin(fromSeconds(start)), drive.duration, start, path);
  return path;
}

py::dict toDict(const OptionMap& values) {
  py::dict settings;
  for (const auto& [name, value] : values) {
    if (const auto* list = std::get_if<UnusableList>(&value))
      throw std::invalid_argument(name + " = " + list->text + ", must be a plain value");
    settings[py::str(name)] = py::str(std::get<std::string>(value));  // a YAML file has texts only
  }
  return settings;
}

}  // namespace
}  // namespace suspension_health_monitor

PYBIND11_MODULE(_bags, module) {
  using namespace suspension_health_monitor;
  module.doc() = "Compiled part of suspension_health_monitor: bags and files.";
  pybind11::module::import("suspension_health_monitor._core");  // which has the classes of the results
  defCommand(module, "identify", &identifyBags);
  defWork<Arguments, std::optional<Baseline>, std::string>(
      module, "health",
      [](const Arguments& arguments, const std::optional<Baseline>& baseline, const std::string& file, LongWork& work) {
        std::optional<HealthyStrut> healthy;
        if (baseline) healthy = HealthyStrut{*baseline, file};
        return watchBags(arguments, healthy, work);
      },
      "arguments", "baseline", "file");
  bindVehicles(module);
  defCommand(module, "compare", [](const Arguments& arguments, LongWork& work) {
    return withDrives(arguments, work, [&](const BagOptions& options, const ModelOptions& models, TopicGaps& gaps) {
      return compareBags(options, models, gaps, work.callback());
    });
  });
  defWork<Arguments, int>(
      module, "diagnose",
      [](const Arguments& arguments, int threads, LongWork& work) {
        return withDrives(arguments, work, [&](const BagOptions& options, const ModelOptions& models, TopicGaps& gaps) {
          RecordedDiagnosis recorded = diagnoseBags(options, models, threads, gaps, work.callback());
          return SearchedStrut{std::move(recorded.found), std::move(recorded.change)};
        });
      },
      "arguments", "threads");
  defWork<std::string, Keywords>(
      module, "simulate",
      [](const std::string& path, const Keywords& keywords, LongWork& work) {
        return writeSimulation(path, keywords.values, work);
      },
      "path", "keywords");
  module.def(
      "read_effects", [](const std::string& path) { return readEffectsFile(path); }, py::arg("path"));
  module.def(
      "read_model", [](const std::string& path, const EffectLibrary& known) { return readModelFile(path, known); },
      py::arg("path"), py::arg("library"));
  module.def(
      "read_baseline", [](const std::string& path) { return readHealthy(path).baseline; }, py::arg("path"));
  module.def(
      "read_settings", [](const std::string& path) { return toDict(readYaml(path)); }, py::arg("path"));
}
