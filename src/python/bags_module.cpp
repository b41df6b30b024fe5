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

namespace py = pybind11;
namespace po = boost::program_options;

po::variables_map parsed(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  addModelOptions(description);
  description.add_options()(kBaseline, po::value<std::string>());
  const po::variables_map values = *parse(arguments, "", description, "bag");
  isOfVehicle(values);  // refuses a strut of none
  return values;
}

namespace {

Identification identifyBags(const Arguments& arguments, LongWork& work) {
  ToolsWork tools(work, 0);
  const BagOptions options = readBagOptions(parsed(arguments));
  Course course;
  RecordedMonitor recorded(options, {}, {}, [&](const MonitorReport& report) { course.add(report); });
  tools.tellReading(options.bags.paths.size());
  recorded.read();
  Identification found = Identification::of(recorded.strut(), recorded.rejected(), course);
  found.change = describeChange(found, knownHealthy({}, options.pipeline), options.pipeline.monitor);
  return found;
}

HealthSummary watchBags(const Arguments& arguments, const std::optional<Baseline>& baseline, const std::string& file,
                        LongWork& work) {
  ToolsWork tools(work, 0);
  const BagOptions options = readLiveOptions(parsed(arguments));
  const auto healthy = baseline ? std::optional(HealthyStrut{*baseline, file}) : std::nullopt;
  Course course;
  RecordedMonitor recorded(options, beforehand(healthy, options.pipeline), {},
                           [&](const MonitorReport& report) { course.add(report); });
  tools.tellReading(options.bags.paths.size());
  recorded.read();
  return HealthSummary::of(recorded.log(), recorded.monitor(), recorded.baselineFile(), recorded.rejected(), course);
}

/// What the search and the comparison begin with.
struct AskedDrives {
  ToolsWork tools;
  po::variables_map values;
  ModelOptions models;
  BagOptions options;
  TopicGaps gaps;

  AskedDrives(const Arguments& arguments, LongWork& work)
      : tools(work, 0),
        values(parsed(arguments)),
        models(readModelOptions(values)),
        options(readBagOptions(values, true)),
        gaps(options.pipeline.shell.input_timeout) {}
};

Comparison compareRecorded(const Arguments& arguments, LongWork& work) {
  AskedDrives asked(arguments, work);
  return compareBags(asked.options, asked.models, asked.gaps, work.callback());
}

SearchedStrut diagnoseRecorded(const Arguments& arguments, int threads, LongWork& work) {
  AskedDrives asked(arguments, work);
  RecordedDiagnosis recorded = diagnoseBags(asked.options, asked.models, threads, asked.gaps, work.callback());
  return {std::move(recorded.found), std::move(recorded.change)};
}

std::string writeSimulation(const std::string& path, const Keywords& keywords, LongWork& work) {
  const ToolsWork tools(work, 1);
  writeBag(makeSimulatedDrive(keywords.values), path);
  return path;
}

py::dict readSettings(const std::string& path) {
  py::dict settings;
  for (const auto& [name, value] : readYaml(path)) {
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
  defCommand<Arguments>(module, "identify", &identifyBags, "arguments");
  defCommand<Arguments, std::optional<Baseline>, std::string>(module, "health", &watchBags, "arguments", "baseline",
                                                              "file");
  bindVehicles(module);
  defCommand<Arguments>(module, "compare", &compareRecorded, "arguments");
  defCommand<Arguments, int>(module, "diagnose", &diagnoseRecorded, "arguments", "threads");
  defCommand<std::string, Keywords>(module, "simulate", &writeSimulation, "path", "keywords");
  module.def("read_effects", &readEffectsFile, py::arg("path"));
  module.def("read_model", &readModelFile, py::arg("path"), py::arg("library"));
  module.def(
      "read_baseline", [](const std::string& path) { return readHealthy(path).baseline; }, py::arg("path"));
  module.def("read_settings", &readSettings, py::arg("path"));
}
