#pragma once

#include "residual_series.h"
#include "suspension_health_monitor/internal/compare/residual_analysis.h"

namespace suspension_health_monitor {

/// @return autocorrelation of the residual, and its correlation with w'', each with the bands of ResidualCorrelation.
struct ResidualCorrelations {
  ResidualCorrelation whiteness, cross;
};
ResidualCorrelations correlate(const ResidualSeries& series, const ExpectedNoise& noise);

}  // namespace suspension_health_monitor
