#pragma once

#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// @return true if the force depends on time at some motion.
bool dependsOnTime(const ActiveEffect& active);

/// The rival of a law that changes with time: the same with the time that the frequency of the wheel's motion tells.
/// Where that does as well, as on a sweep, nobody can tell a part that wears from one that answers to frequency.
/// Frequency: ln of rms velocity over rms position of the wheel (motionError() of w'') in windows of four natural
/// periods. It tells the mean time of the two windows that are next in frequency; in straight lines between the
/// middles.
ForceEffect frequencyRival(const ForceEffect& effect, const Records& records, double stiffness_to_mass);

}  // namespace suspension_health_monitor
