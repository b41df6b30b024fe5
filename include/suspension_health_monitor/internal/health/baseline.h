#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "suspension_health_monitor/internal/health/health_rules.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/monitor_options.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// @return the strut as it is estimated at `stamp`, as healthy: after a service.
Baseline baselineOf(const StrutEstimate& estimate, Stamp stamp);

/// @return the healthy strut by nominal values; empty parts: not given.
Baseline nominalOf(const HealthThresholds& options);

/// The change of the present strut from the healthy one, wherever it drives. Dampers are compared as they act on a road
/// between the present one and the baseline's: friction f counts as f m, m the mean of the gains g of both. Where the
/// law is not Coulomb's, f changes with the road, and what lies between both is not known to (f - f_n) (g - g_n) / 2.
/// Empty parts: no healthy value, no estimate, or one that is not above 0.
MeasuredChange changeFrom(const Baseline& healthy, const StrutEstimate& now);

/// Learns the baseline from a stretch of valid estimates: their mean, over halves that must agree.
///
/// A strut that changes while it is learned is not taken as healthy: if the means of the two halves differ by more than
/// kProven standard deviations and 3 %, learning begins anew. So it does when the clock goes back: that is another
/// drive, perhaps of another vehicle. Estimates whose windows overlap share their errors: those of a mean over t
/// seconds have window / t of the variance of one. What they scatter beyond their standard deviation is part of the
/// baseline; as n windows tell a variance, a later one is judged by Student's distribution of n degrees of freedom,
/// which has n / (n - 2) of the variance. With a thermometer the halves tell how damping goes with the temperature,
/// too. Cost per estimate: O(1), no allocation.
class BaselineLearner {
 public:
  /// @param seconds  to learn from, > 0.
  explicit BaselineLearner(double seconds) : seconds_(seconds) {}

  /// @param seconds  of new data since the last call.
  /// @return the baseline, once it is learned; learning then begins anew.
  std::optional<Baseline> add(Stamp stamp, const StrutEstimate& estimate, double seconds);

  double progress() const { return (halves_[0].seconds + halves_[1].seconds) / seconds_; }  ///< 0..1
  int restarts() const { return restarts_; }  ///< because the strut was changing

 private:
  /// Damping or stiffness over a half.
  struct Parameter {
    double mean = 0.0, stddev = 0.0;  // stddev: that of one estimate, as root mean square
    double variance = 0.0;            // of the estimates
    void add(double value, double its_stddev, double gain);
    // Of both halves; that their means differ by more than `explained` is scatter, too.
    Parameter with(const Parameter& other, double explained) const;
    double spread() const { return std::sqrt(std::max(square(stddev), variance)); }  // of an estimate, scatter included
    double scatter(double windows) const;  // of a later estimate, beyond its standard deviation
  };
  struct Half {
    double seconds = 0.0;
    double window = 0.0;  // mean span of an estimate's window [s]
    Parameter damping, stiffness;
    std::optional<DryFriction> friction;
    std::optional<double> celsius;
    void add(const StrutEstimate& estimate, double seconds);
    double windows() const { return seconds / window; }
    double varianceOfMean(const Parameter& parameter) const;
  };

  bool drifts() const;
  std::optional<DamperTemperature> temperature() const;
  Baseline result(Stamp to) const;

  double seconds_;
  std::array<Half, 2> halves_;
  Stamp from_{}, newest_{};
  int restarts_ = 0;
};

}  // namespace suspension_health_monitor
