#pragma once

#include <limits>
#include <vector>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/health/health_rules.h"

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

/// A strut on one drive against the same strut on another.
struct DriveChange {
  StrutChange strut;           ///< of b1 and b0, payload taken out
  CurveChange damper, spring;  ///< of the forces, payload taken out, too
};

/// Compares two curves at the nodes of both, as far as both reach. A difference counts if chance makes one as large at
/// any of the nodes with a probability of kFalseAlarm (Bonferroni), and if it is above kLeastChange of the force. A
/// range goes on over nodes where the difference has the same sign but is not proven, if it is proven further out.
/// @param mass  of the body, over that of the other drive, by which forces over mass are compared as forces.
CurveChange changeOf(const ForceCurve& now, const ForceCurve& other, const Measured& mass = {0.0, 0.0});

/// @param now, other  valid.  @param payload_range  as splitChange().
DriveChange changeOf(const StrutEstimate& now, const StrutCurves& curves, const StrutEstimate& other,
                     const StrutCurves& other_curves, double payload_range);

}  // namespace suspension_health_monitor
