#pragma once

#include <deque>
#include <optional>

#include "bag_options.h"
#include "suspension_health_monitor/discrepancy/search_drives.h"

namespace suspension_health_monitor {

/// Drives from bags, ready for free runs.
struct BagDrives {
  StrutModel start;                 ///< a damped spring: the model given, or a rough one
  std::deque<DriveRecord> records;  ///< one per bag
};

/// @param model  where to start; without it b1 and b0 by least squares over all bags.
/// @throws InputError, TooLittleError  as readSamples(), if the drives show no damped spring, and if the body's IMU
/// does not measure what the model needs.
BagDrives readDrives(const BagOptions& options, const std::optional<StrutModel>& model);

}  // namespace suspension_health_monitor
