#pragma once

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// strutCurves() of drives that are prepared already.
/// @param model  a damped spring that the sampling can follow.
StrutCurves fitCurves(const Records& records, const StrutModel& model);

}  // namespace suspension_health_monitor
