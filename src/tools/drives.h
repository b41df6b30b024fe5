#pragma once

#include <deque>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/discrepancy/drives.h"

namespace suspension_health_monitor {

/// All samples of each bag.
/// @throws InputError, TooLittleError  as readSamples().
std::vector<Drive> readDrives(const BagOptions& options);

/// As roughModel().
/// @throws TooLittleError  if the drives show no damped spring.
StrutModel requireRoughModel(const std::vector<Drive>& drives, const MonitorOptions& options);

std::vector<const DriveRecord*> pointersTo(const std::deque<DriveRecord>& records);

}  // namespace suspension_health_monitor
