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

/// @return the noise of a vehicle each of whose struts has two accelerometers of its own, all alike.
SensorNoise noiseOfOwnSensors(std::size_t num_struts);

/// @param gyro_noise  standard deviation of a gyro's noise over that of an accelerometer's [s/m].
/// @return the noise of a vehicle's sensors behind its StrutTops.
SensorNoise noiseOfStrutTops(const VehicleChannels& channels, Stamp period, double gyro_noise);

/// @return the number of struts in which a wrong reading of one sensor shows: that of the sensor which shows in most.
std::ptrdiff_t mostStrutsOfASensor(const SensorNoise& noise);

/// @return a drive that is nothing but the noise of all sensors, long enough to tell its size within a percent.
StrutDrives makeNoiseDrive(const SensorNoise& noise, double period);

/// Takes out of every strut's z'' what the residuals of the others tell of its noise. Where one IMU tells the tops of
/// several struts, what its gyro reads wrong moves all of them in step, as no force of a strut does: with the
/// accelerometer there is one reading that is good, and it is shared out among the struts by what they do not explain.
///
/// The residual e_j of strut j is what the free run of its model leaves, all of it noise if the model is right. The
/// noise of strut i is estimated as sum_jl h_jl e_j(k + l), l of a tenth of a second to either side, by the least
/// squares whose moments are those of the known noise (Wiener's filter). To fit the strut to what that leaves is to fit
/// all of them together: seemingly unrelated regressions (Zellner, J. Am. Stat. Ass. 57 (1962), 348-368). What a model
/// lacks shows in the others, too, until it has been found.
/// @param drives  struts that are taken apart, one StrutDrives for each drive; their samples at the ends of a stretch
/// are lost. If a model runs away all stay as they are.
/// @param noise  of the same struts, as separateNoise() gives it; it becomes that of what is left.
/// @param models  by strut.
void takeSharedNoise(std::vector<StrutDrives>& drives, StrutDrives& noise, double period,
                     const std::vector<StrutModel>& models);

/// @return what all accelerometers of a recorded drive read at its k-th instant, and its known forces.
VehicleSample sampleOf(const VehicleDrive& drive, std::size_t k);

/// Writes it down as the next one of a drive, which has its struts and known forces.
void append(const VehicleSample& sample, VehicleDrive& drive);

/// Takes the newest samples of a drive back.
void dropNewest(VehicleDrive& drive, std::size_t count);

/// Takes the samples before a stamp off a drive, or none if these are more than a quarter of it.
void dropBefore(Stamp begin, VehicleDrive& drive);

template <class T>
void dropNewest(std::vector<T>& series, std::size_t count) {
  series.erase(series.end() - static_cast<std::ptrdiff_t>(std::min(count, series.size())), series.end());
}

/// @param rows  of all tops.  @param body  that fits them, if one was looked for.
/// @param forces  names of the known forces.
/// @return what they say, as users see it.
VehicleCoupling describe(const BodyRows& rows, const std::optional<BodyFitResult>& body,
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
