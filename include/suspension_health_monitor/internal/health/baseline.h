#pragma once

#include <optional>

#include "suspension_health_monitor/internal/health/parameter_trend.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// @return the strut as LA estimates it at `stamp`, as healthy: after a service.
Baseline baselineOf(const StrutEstimate& la, Stamp stamp);

/// A parameter of the healthy strut.
struct HealthyValue : UncertainValue {
  double by_friction = 0.0;  ///< what friction makes uncertain of it, a part of stddev
};

/// The healthy strut's parameters; empty: not known.
struct HealthyValues {
  std::optional<HealthyValue> damping, stiffness;  ///< b1 [1/s], b0 [1/s^2]
};

/// @param now  of the present estimates; empty: as when the baseline was learned.
/// @param certain  standard deviations that a change must have to be one: what friction does is as uncertain as it is
/// large (doc/health.md, Another road), so that no change is certain within that.
/// @return as what the healthy strut would be estimated on the present road. Its dry friction f is the same, but not
/// what that makes of b1 and b0, f g: along g b1 has the slope f. Of a damper that is digressive or progressive that
/// slope is not the same on every road; the mean of those at both ends takes b1 from one to the other (the trapezoid
/// rule).
HealthyValues onThisRoad(const Baseline& baseline, const std::optional<DryFriction>& now, double certain);

/// Learns the baseline from a stretch of estimates of LS that LA agrees with: their mean, over halves that must agree.
///
/// A strut that changes while it is learned is not taken as healthy: if the means of the two halves differ by more than
/// kDrift standard deviations and 3 % beyond what dry friction makes of another road, learning begins anew. So it does
/// when the clock goes back: that is another drive, perhaps of another vehicle. Standard deviation of a mean over n
/// rows: that of one estimate times sqrt(2 m / n), with m the estimator's memory: exponential forgetting correlates
/// estimates over 2 m rows. Cost per estimate: O(1), no allocation.
class BaselineLearner {
 public:
  /// @param rows  to learn from, > 0.  @param memory  m of the estimator in rows.
  BaselineLearner(double rows, double memory) : rows_(rows), memory_(memory) {}

  /// @param rows  that have passed since the last call.
  /// @return the baseline, once it is learned; learning then begins anew.
  std::optional<Baseline> add(Stamp stamp, const StrutEstimate& estimate, double rows);

  double progress() const { return (halves_[0].rows + halves_[1].rows) / rows_; }  ///< 0..1
  int restarts() const { return restarts_; }                                       ///< because the strut was changing

 private:
  struct Half {
    double rows = 0.0;
    double damping = 0.0, stiffness = 0.0;                    // means
    double damping_variance = 0.0, stiffness_variance = 0.0;  // means of an estimate's variance
    DryFriction friction;                                     // mean
    double friction_variance = 0.0;                           // likewise
  };

  static constexpr double kDrift = 3.0;
  static constexpr double kLeastDrift = 0.03;  // of the value: less is what another road does

  double friction() const { return (halves_[0].friction.force + halves_[1].friction.force) / 2.0; }
  bool drifts(double Half::*mean, double DryFriction::*gain, double Half::*variance) const;
  Baseline result(Stamp to) const;

  double rows_, memory_;
  Half halves_[2];
  Stamp from_{}, newest_{};
  int restarts_ = 0;
};

}  // namespace suspension_health_monitor
