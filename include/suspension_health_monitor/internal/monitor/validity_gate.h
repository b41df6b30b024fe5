#pragma once

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Share of the measured signal that a model has to explain to be that of the strut.
inline constexpr double kLeastExplained = 0.5;

/// By that share of itself wrong readings may shift a parameter: of more, most of what the rows tell may be theirs.
inline constexpr double kMostWrongShare = 0.5;

/// All that decides whether an estimate is valid.
struct EstimateFacts {
  bool period_fits = true;        ///< samples come at the sample period of the options
  bool has_row = false;           ///< the newest sample gave a regression row: the filter is full
  bool sensor_moves = true;       ///< the body's reading has changed within a horizon
  double rows = 0.0;              ///< that the estimate rests on, of the model's present columns
  double fewest_rows = 0.0;       ///< that it needs
  bool excites_damping = true;    ///< the rows tell of it (Excitation)
  bool excites_stiffness = true;  ///< likewise
  double wrong_share = 0.0;       ///< by which share of itself wrong readings may have shifted a parameter
  double level_share = 0.0;       ///< likewise, if most of it is by an offset that changes, instead of wrong_share
  bool outside_force = false;     ///< something else moves the body, or did within the memory
  double explained = 0.0;         ///< share of the output's size
  bool is_physical = false;       ///< all parameters that have to be above 0 are
  bool skew_is_known = true;      ///< the clocks' skew is one of those that are looked for
  bool has_stddev = false;        ///< the standard deviations are numbers
  bool free_run_fails = false;    ///< the free run fits the body's motion worse than a constant does
};

/// The one place that decides whether an estimate may be trusted.
/// @return the first reason against it, in the order of EstimateDoubt; kNone: the estimate is valid.
EstimateDoubt doubtOf(const EstimateFacts& facts);

}  // namespace suspension_health_monitor
