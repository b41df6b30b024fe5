#pragma once

#include <suspension_health_monitor/Diagnose.h>
#include <suspension_health_monitor/DiagnoseVehicle.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "diagnose_service.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What a live search works on.
struct SearchTask {
  VehicleDrive drive;
  std::vector<std::string> struts;  ///< names; that of a strut alone is empty
  DiagnoseOptions options;
};

/// What is done with the result in the nodelet's queue.
using TakeDiagnosis = std::function<void(const VehicleDiagnosis&)>;

/// @param window  [s] as asked for, 0: everything.  @param kept  [s] diagnose_window.
/// @return how far back to look [s].
/// @throws std::invalid_argument  naming the window and what is allowed.
double searchSpan(double window, double kept);

/// An answer of ~diagnose without one: every figure is NaN.
DiagnoseResponse withoutFigures();

/// diagnoseVehicle() as the work of a vehicle's ~diagnose.
DiagnoseService<DiagnoseVehicle>::Search searchOf(SearchTask task, TakeDiagnosis take);

/// The same as the work of a strut's own ~diagnose: all struts are searched, and the answer is about this one.
DiagnoseService<Diagnose>::Search searchOf(SearchTask task, std::size_t strut, TakeDiagnosis take);

}  // namespace suspension_health_monitor
