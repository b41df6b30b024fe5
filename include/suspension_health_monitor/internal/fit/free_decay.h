#pragma once

#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// The strut of a body that was pushed by hand and let go, several times, on a vehicle that stands.
///
/// While no hand is at the body, from any time t = 0 with u = w'' - z'',
///     z'' = b1 int u + b0 int int u + (b1 d'(0) + b0 d(0)) + b0 d'(0) t + (error of the mean of u) t^2,
/// which is linear in b1, b0 and three numbers of each window. Windows are free where their least squares leave no more
/// than noise does: the tenth of the windows that are left with least tells the noise, so that at least a tenth of the
/// time has to be without hands. Those with much more motion than noise are fitted together.
/// Assumes: white noise; one strut, whose body does not turn; no friction (no window is free then).
/// @param drives  without meaning of gravity: a constant in either reading does not count.
/// @return b1, b0, their standard deviations and correlation; all other fields keep their defaults. kNotExcited if b1
/// or b0 is not known to kMostRelativeStddev.
StrutEstimate estimateFromFreeDecays(const std::vector<Drive>& drives);

}  // namespace suspension_health_monitor
