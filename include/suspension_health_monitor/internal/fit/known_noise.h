#pragma once

#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// What the noise of all sensors leaves of a free run [m/s^2] where the records have what that noise looks like
/// (DriveRecord::noise()): its spectrum is known but for its size. That is the median over the frequencies of what the
/// model leaves over what it leaves of the noise. A law that the model lacks is at less than half of all frequencies.
/// @param model  its b1 and b0 count for the noise.
/// @return 0 if there is too little to tell, or the model runs away.
double floorOfKnownNoise(const Records& records, const StrutModel& model);

}  // namespace suspension_health_monitor
