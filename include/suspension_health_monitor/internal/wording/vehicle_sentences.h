#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/internal/vehicle/gravity.h"
#include "suspension_health_monitor/internal/vehicle/imu_survey.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_claims.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// @return why the rows of the struts are not known, to be read after "the drives".
std::string whyNotCoupled(const VehicleMistake& mistake, const std::vector<std::string>& struts);

/// @return what in the vehicle file is likely wrong, and the mend, in a sentence; empty: nothing that the data tell.
std::string describe(const VehicleMistake& mistake, const std::vector<std::string>& struts);

/// @return why it is not known how the body's mass is spread, in a sentence; empty if it is.
std::string describe(InertiaDoubt doubt);

/// @return how the body's IMU was found to be turned, if it was; else empty.
std::string describe(const BodyLevel& level);

/// @param name  of the IMU.  @param setting  that names its axis.
/// @return how gravity contradicts the settings, and the mend; empty: it does not.
std::string describe(const MountClaim::Finding& mount, const std::string& name, const char* setting);

/// @param axis  of the IMU that points up or down.  @param moved  rms along it, of the body's and the wheel's motion.
/// @return what is wrong with the readings of an IMU, the worst first, and what to do, in a sentence; empty: nothing.
std::string describeFault(const ImuSurvey& imu, int axis, double moved);

/// To be added to a reason.
inline constexpr const char* kWheelsFolded =
    "; a wheel still shakes at half the sampling rate, which is the likely cause: record at twice the rate, or with "
    "the filter of the IMU set below half of it";

/// @return the verdict in a sentence.
std::string summaryOf(const VehicleDiagnosis& diagnosis, const std::vector<std::string>& struts);

}  // namespace suspension_health_monitor
