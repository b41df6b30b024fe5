#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_sample.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// @return what all accelerometers of a recorded drive read at its k-th instant, and its known forces.
VehicleSample sampleOf(const VehicleDrive& drive, std::size_t k);

/// Writes it down as the next one of a drive, which has its struts and known forces.
void append(const VehicleSample& sample, VehicleDrive& drive);

/// Takes the newest samples of a drive back.
void dropNewest(VehicleDrive& drive, std::size_t count);

template <class T>
void dropNewest(std::vector<T>& series, std::size_t count) {
  series.erase(series.end() - static_cast<std::ptrdiff_t>(std::min(count, series.size())), series.end());
}

/// @param rows  of all tops; nullptr: not known, for this reason.  @param body  that fits them, if one was looked for.
/// @param forces  names of the known forces.
/// @return what they say, as users see it.
VehicleCoupling describe(const BodyRows* rows, const std::optional<BodyFitResult>& body, const std::string& why_none,
                         const std::vector<std::string>& forces);

/// @return T [s]: as given, or the median spacing of the samples.
/// @throws std::invalid_argument  if there is no drive, or drives have other struts or known forces than one another;
/// if the struts of one have not the same stamps or filter, or a force not a value for each.
double periodOf(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                const std::optional<double>& given);

/// Every strut of a recorded drive on its own, by the Decoupler as live.
/// @param models  of the struts, as they are known.
/// @return drives of quarter cars; each series is shorter by what the Decoupler needs to begin with.
StrutDrives separateStruts(const VehicleDrive& drive, double period, const BodyRows& rows,
                           const std::vector<StrutModel>& models);

/// @param noise  of the sensors, that is not empty.
/// @return by strut what it becomes as the drives are separated: a long series.
StrutDrives separateNoise(const SensorNoise& noise, double period, const BodyRows& rows);

}  // namespace suspension_health_monitor
