#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

namespace suspension_health_monitor {

/// Error of the free run over all segments.
/// @return nothing if the measurement does not move.
std::optional<PredictionError> freeRunError(const std::vector<ComparedSegment>& segments);

/// Error of the regression rows with the model's numbers,
///   I_2^2 y = b1 I_1^2 u + b0 I_0^2 u + sum_j c_j I_2^2 f_j,   u = w'' - y,
/// f_j from the free run's travel and rate: what the live estimators see of the model. A fault of the reading is taken
/// out of y to first order.
/// @param filter  its period is that of the segments.
/// @return nothing if no segment is longer than the filter.
std::optional<PredictionError> oneStepError(const std::vector<ComparedSegment>& segments, const StrutModel& model,
                                            const IntegralFilterOptions& filter);

}  // namespace suspension_health_monitor
