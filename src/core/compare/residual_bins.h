#pragma once

#include <vector>

#include "residual_series.h"
#include "suspension_health_monitor/internal/compare/residual_analysis.h"

namespace suspension_health_monitor {

/// @param segments  those of the series.
std::vector<TimeBin> binByTime(const ResidualSeries& series, const std::vector<ComparedSegment>& segments);

/// @param x  one value per sample.
std::vector<ResidualBin> binByQuantile(const ResidualSeries& series, const std::vector<double>& x);

DirectionLoop compareDirections(const ResidualSeries& series);

ForceSurface mapForce(const ResidualSeries& series);

}  // namespace suspension_health_monitor
