#pragma once

#include <optional>

#include "residual_series.h"
#include "suspension_health_monitor/internal/compare/residual_analysis.h"

namespace suspension_health_monitor {

/// @param segments  those of the series.
/// @return nothing if not even two windows fit into the segments.
std::optional<ResidualSpectrum> spectrumOf(const ResidualSeries& series, const std::vector<ComparedSegment>& segments,
                                           const ExpectedNoise& noise);

}  // namespace suspension_health_monitor
