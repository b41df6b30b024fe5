// The compiled part of the Python module that reads and writes bags and files, by the code of the command line.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <stdexcept>

#include "../ros/model_file.h"
#include "../ros/simulated_drive.h"
#include "../ros/yaml_settings.h"
#include "../tools/command.h"
#include "../tools/strut_files.h"
#include "bags_call.h"

namespace suspension_health_monitor {

namespace py = pybind11;

namespace {

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
}  // namespace suspension_health_monitor

PYBIND11_MODULE(_bags, module) {
  using namespace suspension_health_monitor;
  module.doc() = "Compiled part of suspension_health_monitor: bags and files.";
  pybind11::module::import("suspension_health_monitor._core");  // which has the classes of the results
  bindBags(module);
  defCommand<std::string, OptionMap>(module, "simulate", &writeSimulation, "path", "keywords");
  module.def("read_effects", &readEffectsFile, py::arg("path"));
  module.def("read_model", &readModelFile, py::arg("path"), py::arg("library"));
  module.def("read_baseline", &readHealthy, py::arg("path"));
  module.def("read_settings", &readSettings, py::arg("path"));
}
