#include "../ros/shell_options.h"  // of its folder the file without ROS
#include "bindings.h"
#include "options.h"
#include "readings.h"

namespace suspension_health_monitor {

namespace py = pybind11;

void bindReadings(py::module& module) {
  py::class_<Recording>(module, "Readings", "Arrays of one drive, checked and ready to be read.")
      .def(py::init([](const std::vector<std::pair<py::array_t<std::int64_t>, py::array_t<double>>>& arrays,
                       const std::optional<py::array_t<double>>& across) {
             std::vector<ReadingStream> streams;
             for (const auto& [stamps, values] : arrays) streams.push_back({stamps, values});
             return Recording(std::move(streams), across);
           }),
           py::arg("streams"), py::arg("across"));
  py::class_<Keywords>(module, "Keywords", "Options by their full names.")
      .def("with_defaults",
           [](Keywords self, const Keywords& defaults) {
             self.values.insert(defaults.values.begin(), defaults.values.end());
             return self;
           })
      .def("without_messages", &Keywords::withoutMessages, "Those that arrays have a use for.")
      .def_property_readonly(
          "assignments", [](const Keywords& self) { return assignmentsOf(self.values); },
          "NAME=VALUE each, for `--set`");
  module.def(
      "monitor_keywords",
      [](const py::dict& keywords, const std::vector<std::string>& arguments) {
        return takeKeywords(keywords, PipelineOptions::describe(), arguments);
      },
      py::arg("keywords"), py::arg("arguments"),
      "The keywords of a call by the options' full names; refuses an unknown one, naming the nearest.");
}

}  // namespace suspension_health_monitor
