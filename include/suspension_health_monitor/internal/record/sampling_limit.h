#pragma once

#include <vector>

#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// How strongly the wheel still shakes at half the sampling rate: power density of w'' there, in a band of about a
/// sixteenth, over the mean one. 1 for white noise; above about a quarter a part of the motion lies beyond and is lost
/// to any model.
double powerAtSamplingLimit(const Records& records);

}  // namespace suspension_health_monitor
