#pragma once

#include <limits>

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// @return true if b1 and b0 of two estimators are within kLeastDifference, or kCertain standard deviations, of each
/// other.
bool agree(const StrutEstimate& a, const StrutEstimate& b);

/// All that decides whether an estimate is valid. What does not concern an estimator stays as it is here.
struct EstimateFacts {
  bool period_fits = true;        ///< samples come at the sample period of the options
  bool unit_fits = true;          ///< both IMUs read in m/s^2
  bool has_row = false;           ///< the newest sample gave a regression row; the blocks gave an estimate
  double rows = 0.0;              ///< that the estimate rests on, of the model's present columns
  double fewest_rows = 0.0;       ///< that it needs
  double damping_stddev = 0.0;    ///< relative, without the model's error [-]
  double stiffness_stddev = 0.0;  ///< likewise
  double explained = 1.0;         ///< share of the output's size
  bool is_physical = true;        ///< all parameters that have to be above 0 are
  double age = 0.0;               ///< of the data [s]
  double oldest = std::numeric_limits<double>::infinity();  ///< that may still count [s]
  bool agrees = true;                                       ///< with the block estimate, as agree() says
  bool free_run_fails = false;  ///< the free run fits the body's motion worse than a constant does
  /// relative, the larger one of b1 and b0, with the model's error [-]; infinite: a dead gyro
  double absolute_stddev = 0.0;
};

/// The one place that decides whether an estimate may be trusted.
/// @return the first reason against it, in the order of EstimateDoubt; kNone: the estimate is valid.
EstimateDoubt doubtOf(const EstimateFacts& facts);

}  // namespace suspension_health_monitor
