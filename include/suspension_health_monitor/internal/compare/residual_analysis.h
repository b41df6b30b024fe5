#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/compare.h"

namespace suspension_health_monitor {

/// Sources: L. Ljung, System Identification, 2nd ed. (1999), ch. 16 (residual tests, bands); M. S. Bartlett, J. Royal
/// Statistical Society B 8 (1946), 27-41 (variance of correlations); P. D. Welch, IEEE Trans. Audio Electroacoustics 15
/// (1967), 70-73; G. C. Carter, Proc. IEEE 75 (1987), 236-255 (coherence).
/// @param segments  of one period.
/// @param strut  b1 and b0 above 0: how noise on w'' comes through.
/// @param noise_floor  rmse that the noise of both sensors leaves of a free run [m/s^2].
/// @return nothing if nothing moves.
std::optional<ResidualViews> viewResidual(const std::vector<ComparedSegment>& segments, const LinearStrut& strut,
                                          double noise_floor);

/// Ranks the regions where the model is significantly worse than noise, the worst first, at most two of a view.
/// Significant: a mean missing force beyond chance (probability 0.001 over all bins of the view) and more than a
/// quarter of the noise floor; or a residual whose mean square noise cannot give, and which is worse than elsewhere.
/// @return the facts, without words (wording/failure_sentences.h). At least one entry: if nothing fails the only one
/// says so (FailureView::kNone).
std::vector<FailureRegion> findFailures(const ResidualViews& views, const LinearStrut& strut, double noise_floor);

}  // namespace suspension_health_monitor
