#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/model/strut_integrator.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// Sources: L. Ljung, System Identification, 2nd ed. (1999), ch. 16 (residual tests, bands); M. S. Bartlett, J. Royal
/// Statistical Society B 8 (1946), 27-41 (variance of correlations); P. D. Welch, IEEE Trans. Audio Electroacoustics 15
/// (1967), 70-73; G. C. Carter, Proc. IEEE 75 (1987), 236-255 (coherence).
/// @param segments  of one period.
/// @param strut  b1 and b0 above 0: how noise on w'' comes through.
/// @return nothing if nothing moves.
std::optional<ResidualViews> viewResidual(const std::vector<ComparedSegment>& segments, const LinearStrut& strut,
                                          const NoiseFloor& noise_floor);

/// Ranks the regions where the model is significantly worse than noise, the worst first, at most two of a view.
/// Significant: a mean missing force beyond chance (probability 0.001 over all bins of the view) and more than a
/// quarter of the noise floor; or a residual whose mean square noise cannot give, and which is worse than elsewhere.
/// @return the facts, without words (wording/failure_sentences.h). At least one entry: if nothing fails the only one
/// says so (FailureView::kNone).
std::vector<FailureRegion> findFailures(const ResidualViews& views, const LinearStrut& strut, double noise_floor);

/// @return the range of nearly all values: single extremes would stretch an axis.
std::pair<double, double> coveredRange(Eigen::VectorXd values);

struct ComparedDrives {
  std::vector<ComparedSegment> segments;
  FreeMotion motion;  ///< of the free runs
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

/// @param segments  compared by the model.  @param motion  of the free run.
/// @return one per effect of the model, in its order; what the reading does is no force.
std::vector<PartialResidual> partialResiduals(const std::vector<ComparedSegment>& segments, const FreeMotion& motion,
                                              const StrutModel& model);

/// compare() of drives that are prepared already; without words for people.
/// @param options  its period and model are not looked at.
Comparison compareModel(const Records& records, const StrutModel& model, const CompareOptions& options = {});

}  // namespace suspension_health_monitor
