// The compiled part of the Python module that needs no ROS; python/suspension_health_monitor wraps it.
#include "bindings.h"

PYBIND11_MODULE(_core, module) {
  using namespace suspension_health_monitor;
  module.doc() = "Compiled part of suspension_health_monitor: arrays in, results out.";
  bindReadings(module);
  bindModel(module);
  bindReports(module);
  bindIdentification(module);
  bindViews(module);
  bindComparison(module);
  bindDiagnosis(module);
  bindHealth(module);
  bindSimulation(module);
  bindStrutMonitor(module);
  bindVehicleMonitor(module);
}
