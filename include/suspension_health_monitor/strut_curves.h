#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// A force over the body's mass as a function of one variable: linear between nodes, 0 at 0. It ends where its standard
/// deviation is above a tenth of the force there and of the linear model's usual (rms) one. Empty: nothing is known.
struct ForceCurve {
  std::vector<double> at;      ///< nodes, ascending, one of them 0 [m/s] or [m]
  std::vector<double> force;   ///< positive: pushes the body up [m/s^2]
  std::vector<double> stddev;  ///< by noise and by what straight lines miss: force +- 1.645 stddev holds nine tenths of
                               ///< the law [m/s^2]

  bool covers(double x) const { return !at.empty() && x >= at.front() && x <= at.back(); }

  /// @pre covers(x).
  double forceAt(double x) const;
  double stddevAt(double x) const;
};

/// What damper and spring do, as drives show it: z'' = damper(v) + spring(d) and what the model's effects add that
/// neither variable decides alone (memory, d^2 v, t v; those of time as they are at the start).
///
/// Both are 0 at 0, so that travel counts from where the strut would rest. A constant force cannot be told from an
/// offset of a sensor: it is in neither. Forces of other laws with memory, or of two variables, that the model lacks
/// come into the curves in part, and the standard deviations do not know of them.
struct StrutCurves {
  ForceCurve damper;  ///< over travel rate v: compression above 0, rebound below
  ForceCurve spring;  ///< over travel d: compression above 0
};

/// Output-error fit of two piecewise linear laws with nodes where they bend (doc/equations.md, Curves).
/// @param drives  of one strut, sampled alike.
/// @param model  a damped spring to start with. Its laws of one variable are the first guess; the others, and the
/// faults of the reading, are taken as they are.
/// @param sample_period  T [s]; nothing: the median spacing of the samples.
/// @return empty curves if the drives are too short, or the model does not fit them at all.
/// @throws std::invalid_argument  if there is no drive, the period is not above 0 or an effect is not usable.
StrutCurves strutCurves(const std::vector<Drive>& drives, const StrutModel& model,
                        const std::optional<double>& sample_period = {});

}  // namespace suspension_health_monitor
