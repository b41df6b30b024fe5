#pragma once

#include "suspension_health_monitor/internal/vehicle/coupling_estimate.h"

namespace suspension_health_monitor {

/// Fills in what an estimate does not know: its standard deviations, which struts its rows tell apart least, its doubt.
/// @param moments  of the rows, about their mean, with the noise's.
/// @param noise  moments of noise whose standard deviation is 1 in every sensor.
/// @param rows  how many of independent errors the moments are of.
void describeErrors(const CouplingMoments& moments, const CouplingMoments& noise, double rows,
                    CouplingEstimate& estimate);

}  // namespace suspension_health_monitor
