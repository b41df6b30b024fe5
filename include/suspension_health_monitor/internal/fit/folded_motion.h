#pragma once

#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// What a wheel that shakes beyond half the sampling rate may leave of a free run [m/s^2]: without a filter before the
/// sampling such motion is folded back, and no model can follow it. It is taken to be white, with the density that w''
/// has just below half the rate, and to pass the strut as it does there.
/// @return 0 if the drives are too short to tell.
double foldedMotion(const Records& records, const StrutModel& model);

/// Above this share of its motion that is folded back a wheel is sampled too slowly for anything to be told.
inline constexpr double kMostFolded = 0.25;

/// @return rms of white motion as dense as that of w'' just below half the rate, over that of w''.
double shareAtSamplingLimit(const Records& records);

}  // namespace suspension_health_monitor
