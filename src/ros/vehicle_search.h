#pragma once

#include <suspension_health_monitor/Diagnose.h>
#include <suspension_health_monitor/DiagnoseVehicle.h>

#include <functional>
#include <string>
#include <vector>

#include "diagnose_service.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What a live search in a vehicle works on.
struct VehicleSearchTask {
  VehicleDrive drive;
  std::vector<std::string> struts;
  DiagnoseOptions options;
};

/// diagnoseVehicle() as the work of ~diagnose.
/// @param take  what is done with the result in the nodelet's queue.
DiagnoseService<DiagnoseVehicle>::Search searchOf(VehicleSearchTask task,
                                                  std::function<void(const VehicleDiagnosis&)> take);

/// The same as the work of a strut's own diagnose: all struts are searched, and the answer is about this one.
DiagnoseService<Diagnose>::Search searchOf(VehicleSearchTask task, std::size_t strut,
                                           std::function<void(const VehicleDiagnosis&)> take);

}  // namespace suspension_health_monitor
