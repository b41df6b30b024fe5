#pragma once

#include <vector>

#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// Puts the body's motion beside the samples of a drive's segments, as DriveRecord says.
/// @param motion  in the order of the stamps, by the clock of the samples; may be empty.
void addBodyChannels(const std::vector<BodyMotion>& motion, std::vector<DriveSegment>& segments);

}  // namespace suspension_health_monitor
