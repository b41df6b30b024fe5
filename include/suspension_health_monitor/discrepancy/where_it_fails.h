#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/discrepancy/residual_views.h"

namespace suspension_health_monitor {

/// From which side a failure of the model is seen.
enum class FailureView { kOffset, kTime, kTravel, kTravelRate, kSurface, kDirection, kFrequency, kEverywhere, kNone };

/// A part of the drive where the model fails.
struct FailureRegion {
  FailureView view = FailureView::kNone;  ///< kNone: nothing fails; what is left is noise
  std::string region;                     ///< in a few words, e.g. "travel above 21 mm"
  std::string sentence;                   ///< for a mechanic: where, how often, how much, compared with elsewhere
  double rmse = 0.0;                      ///< of the free run in the region; kFrequency: of that band alone [m/s^2]
  double rmse_elsewhere = 0.0;            ///< [m/s^2]; 0 if the region is everything
  double mean = 0.0;                      ///< mean missing force in the region; kOffset: mean residual [m/s^2]
  double share = 1.0;                     ///< of the samples
  double from = 0.0, to = 0.0;  ///< edges: time [s], travel [m], rate [m/s] or frequency [Hz]; of kSurface the travel
};

/// Ranks the regions where the model is significantly worse than noise, the worst first, at most two of a view.
/// Significant: a mean missing force beyond chance (probability 0.001 over all bins of the view) and more than a
/// quarter of the noise floor; or a residual whose mean square noise cannot give, and which is worse than elsewhere.
/// Numbers in the sentences have the SI prefix that reads well for these drives.
/// @return at least one entry; if nothing fails the only one says so (FailureView::kNone).
std::vector<FailureRegion> whereItFails(const ResidualViews& views, const ExpectedNoise& noise);

}  // namespace suspension_health_monitor
