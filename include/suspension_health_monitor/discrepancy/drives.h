#pragma once

#include <deque>
#include <vector>

#include "suspension_health_monitor/corner_sample.h"
#include "suspension_health_monitor/discrepancy/drive_record.h"
#include "suspension_health_monitor/identification/linear_integral_filter.h"
#include "suspension_health_monitor/model/strut_model.h"

namespace suspension_health_monitor {

/// All samples of a drive, oldest first.
using Drive = std::vector<CornerSample>;

/// Rough b1 and b0 by least squares over all rows of all drives, where fits start.
/// @return the linear strut. Its numbers need not be above 0: these drives may show no damped spring.
StrutModel roughModel(const std::vector<Drive>& drives, const IntegralFilterOptions& filter);

/// Prepares drives for free runs of a model, each integration step short against the strut's fastest time.
/// @param period  T [s].  @param model  b1, b0 > 0.
std::deque<DriveRecord> makeRecords(const std::vector<Drive>& drives, double period, const StrutModel& model);

}  // namespace suspension_health_monitor
