// The compiled part of the Python module that reads and writes bags and files, by the code of the command line.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../ros/model_file.h"
#include "../ros/simulated_drive.h"
#include "../ros/yaml_settings.h"
#include "../tools/command.h"
#include "../tools/long_work.h"
#include "../tools/recorded_drives.h"
#include "../tools/recorded_monitor.h"
#include "../tools/strut_files.h"
#include "long_work.h"
#include "results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {
namespace {

/// While it lives, what the tools do on this thread (src/tools/long_work.h) is part of a long work of Python.
class ToolsWork : boost::noncopyable {
 public:
  /// @param bags  number of bags whose reading the callback reports; 0: it reports something else.
  explicit ToolsWork(LongWork& work, std::size_t bags = 0) : work_(work), bags_(bags), before_(current) {
    current = this;
  }
  ~ToolsWork() { current = before_; }

  /// From now on the callback reports the reading of so many bags.
  void tellReading(std::size_t bags) {
    bags_ = bags;
    begun_ = 0;
  }

  void beginBar() { ++begun_; }
  void update(double share) {
    if (bags_ == 0) return step();
    const auto others = static_cast<double>(std::min(begun_, bags_)) - 1.0;
    work_.update((others + share) / static_cast<double>(bags_));
  }
  void step() { work_.step(); }

  static thread_local ToolsWork* current;

 private:
  LongWork& work_;
  std::size_t bags_, begun_ = 0;
  ToolsWork* before_;
};

thread_local ToolsWork* ToolsWork::current = nullptr;

/// Adds what the command line does, as defWork(); its errors are ValueError.
template <class... Given, class Work, class... Names>
void defCommand(py::module& module, const char* name, const Work& work, const Names&... names) {
  const auto command = [work](auto&... given) {
    try {
      return work(given...);
    } catch (const py::error_already_set&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw py::value_error(error.what());
    }
  };
  defWork<Given...>(module, name, command, names...);
}

/// @param arguments  as on the command line, of any of the commands.
po::variables_map parsed(const Arguments& arguments) {
  po::options_description description = bagOptions();
  addModelOptions(description);
  description.add_options()(kBaseline, po::value<std::string>());
  return *parse(arguments, "", description, "bag");
}

/// @param make  makes the result of a strut, by its place.
/// @return results by names; that of a strut alone is empty.
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
  ToolsWork tools(work);
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
  ToolsWork tools(work);
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
  const ToolsWork tools(work);
  AskedDrives asked(parsed(arguments));
  asked.read();
  RecordedComparison found = compareBags(asked, work.callback());
  return byStrut(asked.options, [&](std::size_t i) { return std::move(found.struts[i]); });
}

auto diagnoseDrives(const Arguments& arguments, int threads, LongWork& work) {
  const ToolsWork tools(work);
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

std::string writeSimulation(const std::string& path, const OptionMap& keywords, LongWork& work) {
  const ToolsWork tools(work, 1);
  writeBag(makeSimulatedDrive(keywords), path);
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

// What src/tools/long_work.h promises, for a module of Python: signals belong to the interpreter, which turns Ctrl-C
// into KeyboardInterrupt, and progress goes to a callback instead of a bar.

Interruption::Interruption() = default;
Interruption::~Interruption() = default;

void Interruption::check() {
  if (ToolsWork::current != nullptr) ToolsWork::current->step();
}

Progress::Progress(std::string label, double total) : label_(std::move(label)), total_(total), visible_(false) {
  if (ToolsWork::current != nullptr) ToolsWork::current->beginBar();
}

Progress::~Progress() = default;

void Progress::clear() {}  // nothing is drawn

void Progress::update(double done) {
  if (ToolsWork::current != nullptr && total_ > 0.0) ToolsWork::current->update(done / total_);
}

}  // namespace suspension_health_monitor

PYBIND11_MODULE(_bags, module) {
  using namespace suspension_health_monitor;
  using py::arg;
  module.doc() = "Compiled part of suspension_health_monitor: bags and files.";
  py::module::import("suspension_health_monitor._core");  // which has the classes of the results
  defCommand<Arguments>(module, "identify", &identifyBags, "arguments");
  defCommand<Arguments, std::optional<Baseline>, std::string>(module, "health", &watchBags, "arguments", "baseline",
                                                              "file");
  defCommand<Arguments>(module, "compare", &compareDrives, "arguments");
  defCommand<Arguments, int>(module, "diagnose", &diagnoseDrives, "arguments", "threads");
  defCommand<std::string, OptionMap>(module, "simulate", &writeSimulation, "path", "keywords");
  module.def("read_effects", &readEffectsFile, arg("path"));
  module.def("read_model", &readModelFile, arg("path"), arg("library"));
  module.def("read_baseline", &readHealthy, arg("path"));
  module.def("read_settings", &readSettings, arg("path"));
}
