#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// @return of the free run, per segment and sample.
Residuals residualsOf(const std::vector<ComparedSegment>& segments);

struct ComparedDrives {
  std::vector<ComparedSegment> segments;
  std::vector<std::vector<StrutState>> motion;  ///< of the free runs, per segment and sample
};

/// Runs the model freely over all segments of all drives.
///
/// The residual r of a free run is not yet the force that is missing: the run's travel is wrong by -(r integrated
/// twice), and the model's force with it. A missing force f leaves r = f s^2 / (s^2 + b1 s + b0), in quadrature with f
/// at the strut's natural frequency and with the wrong sign below. So
///   missing force = y - model(d - J J r, v - J r),
/// J an integral that forgets what is slower than a third of the natural frequency w0 (or drift would win): each is
/// multiplied by w^4 / (w^4 + (w0/3)^4), without a change of phase. A constant in r is left out.
/// @param initial  per segment of all records.
/// @return nothing if the model runs away.  @pre model.stiffness_to_mass > 0.
std::optional<ComparedDrives> compareSegments(const Records& records, const StrutModel& model,
                                              const std::vector<StrutState>& initial);

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

/// @param segments  compared by the model.  @param motion  of the free run, per segment and sample.
/// @return one per effect of the model, in its order; what the reading does is no force.
std::vector<PartialResidual> partialResiduals(const std::vector<ComparedSegment>& segments,
                                              const std::vector<std::vector<StrutState>>& motion,
                                              const StrutModel& model);

/// compare() of drives that are prepared already; without words for people.
/// @param options  its period and model are not looked at.
Comparison compareModel(const Records& records, const StrutModel& model, const CompareOptions& options = {});

}  // namespace suspension_health_monitor
