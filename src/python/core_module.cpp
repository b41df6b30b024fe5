// The compiled part of the Python module that needs no ROS; python/suspension_health_monitor wraps it.
#include "bindings.h"
#include "options.h"

PYBIND11_MODULE(_core, module) {
  using namespace suspension_health_monitor;
  module.doc() = "Compiled part of suspension_health_monitor: arrays in, results out.";
  py::class_<Recording>(module, "Readings", "Arrays of one drive, checked and ready to be read.")
      .def(py::init<std::vector<ReadingStream>, std::optional<py::array_t<double>>>(), py::arg("streams"),
           py::arg("across"));
  py::class_<UnusableList>(module, "UnusableList", "A value that no option takes.")
      .def(py::init<std::string>())
      .def("__str__", [](const UnusableList& list) { return list.text; });
  module.def("monitor_keywords", &keywordsOf<PipelineOptions>, py::arg("keywords"), py::arg("arguments"),
             "The keywords of a call by the options' full names; refuses an unknown one, naming the nearest.");
  module.def("without_messages", &withoutMessages, py::arg("keywords"), "Those that arrays have a use for.");
  bindModel(module);
  bindReports(module);
  bindResults(module);
  bindWork(module);
  bindSimulation(module);
  bindMonitors(module);
}
