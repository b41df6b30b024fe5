#pragma once

#include <vector>

#include "suspension_health_monitor/internal/vehicle/coupling_survey.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// @return what all accelerometers of a recorded drive read at its k-th instant, and its known forces.
VehicleSample sampleOf(const VehicleDrive& drive, std::size_t k);

/// Writes it down as the next one of a drive, which has its struts and known forces.
void append(const VehicleSample& sample, VehicleDrive& drive);

/// @param names  of the struts.  @param forces  names of the known forces.
/// @return an estimate as users see it.
VehicleCoupling describe(const CouplingEstimate& estimate, const std::vector<std::string>& names,
                         const std::vector<std::string>& forces);

/// @return the names of the forces that are known in a drive.
std::vector<std::string> forceNames(const VehicleDrive& drive);

/// @param drives  of one vehicle.
/// @return the coupling of its struts over all of them.
/// @throws std::invalid_argument  if the struts of a drive have not the same stamps, or as CouplingSurvey.
CouplingEstimate coupleStruts(const std::vector<VehicleDrive>& drives, double period);

/// Every strut of a recorded drive on its own, by the Decoupler as live.
/// @param models  of the struts, as they are known.
/// @return drives of quarter cars; each series is shorter by what the Decoupler needs to begin with.
StrutDrives separateStruts(const VehicleDrive& drive, double period, const Coupling& coupling,
                           const std::vector<StrutModel>& models);

/// @param noise  of the sensors, that is not empty.
/// @return by strut what it becomes as the drives are separated: a long series.
StrutDrives separateNoise(const SensorNoise& noise, double period, const CouplingEstimate& estimate);

}  // namespace suspension_health_monitor
