#pragma once

#include <vector>

#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// Takes out of every strut's z'' what the residuals of the others tell of its noise. Where one IMU tells the tops of
/// several struts, what its gyro reads wrong moves all of them in step, as no force of a strut does: with the
/// accelerometer there is one reading that is good, and it is shared out among the struts by what they do not explain.
///
/// The residual e_j of strut j is what the free run of its model leaves, all of it noise if the model is right. The
/// noise of strut i is told by sum_jl h_jl e_j(k + l), l of a tenth of a second to either side, by the least squares
/// whose moments are those of the known noise (Wiener's filter). To fit the strut to what that leaves is to fit all of
/// them together: seemingly unrelated regressions (Zellner, J. Am. Stat. Ass. 57 (1962), 348-368). What a model lacks
/// shows in the others, too, until it has been found.
/// @param drives  struts that are taken apart, one StrutDrives for each drive; their samples at the ends of a stretch
/// are lost. If a model runs away all stay as they are.
/// @param noise  of the same struts, as separateNoise() gives it; it becomes that of what is left.
/// @param models  by strut.
void takeSharedNoise(std::vector<StrutDrives>& drives, StrutDrives& noise, double period,
                     const std::vector<StrutModel>& models);

}  // namespace suspension_health_monitor
