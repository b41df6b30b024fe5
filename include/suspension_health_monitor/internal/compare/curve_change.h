#pragma once

#include <limits>
#include <vector>

#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {

/// Where a curve differs from that of another drive.
struct CurveChange {
  /// A part of one side: compression above 0, rebound below.
  struct Range {
    double from, to;  ///< outwards: |from| <= |to|; nodes [m/s] or [m]
    bool to_end;      ///< `to` is as far as both curves reach
    bool softer;      ///< the force is smaller than that of the other drive
  };
  std::vector<Range> ranges;
  /// The smallest relative change of the whole curve that would show at some node; infinite: nothing to compare.
  double least = std::numeric_limits<double>::infinity();
};

/// The body's mass over that of the other drive.
struct MassRatio {
  double value = 1.0, stddev = 0.0;
};

/// Compares two curves at the nodes of both, as far as both reach. A difference counts if chance makes one as large at
/// any of the nodes with a probability of kFalseAlarm (Bonferroni), and if it is above kLeastChange of the force. A
/// range goes on over nodes where the difference has the same sign but is no longer proven, if it is proven further
/// out.
/// @param mass  by which the forces over mass are compared as forces.
CurveChange changeOf(const ForceCurve& now, const ForceCurve& other, const MassRatio& mass = {});

}  // namespace suspension_health_monitor
