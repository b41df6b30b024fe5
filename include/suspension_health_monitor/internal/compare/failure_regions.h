#pragma once

#include <vector>

#include "suspension_health_monitor/internal/compare/residual_analysis.h"

namespace suspension_health_monitor {

/// Ranks the regions where the model is significantly worse than noise, the worst first, at most two of a view.
/// Significant: a mean missing force beyond chance (probability 0.001 over all bins of the view) and more than a
/// quarter of the noise floor; or a residual whose mean square noise cannot give, and which is worse than elsewhere.
/// @return the facts, without words (wording/failure_sentences.h). At least one entry: if nothing fails the only one
/// says so (FailureView::kNone).
std::vector<FailureRegion> findFailures(const ResidualViews& views, const ExpectedNoise& noise);

}  // namespace suspension_health_monitor
