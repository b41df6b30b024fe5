#pragma once

#include <algorithm>
#include <boost/circular_buffer.hpp>
#include <cstddef>
#include <optional>
#include <utility>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// @param range  the smallest and the largest of several changes.
/// @return the change that all of them have in common: the smallest in size; 0 if they differ in sign.
inline double nearestToNone(const std::pair<double, double>& range) {
  return std::clamp(0.0, range.first, range.second);
}

/// Both parameters against those of the healthy strut, as ln(value / healthy).
struct MeasuredChange {
  std::optional<Measured> damping, stiffness;  ///< x1, x0, of whatever cause; empty: cannot be judged
  double correlation = 0.0;                    ///< of the errors of x1 and x0 [-]
  bool is_mostly_friction = false;             ///< x1 is uncertain mostly by what friction makes of another road
};

/// What has changed: body mass, damping, stiffness, each relative to the healthy strut (0: not at all).
struct StrutChange {
  MeasuredChange measured;
  std::optional<double> damping, stiffness;
  std::optional<double> payload;            ///< of the body's mass; empty: only one of the two parameters can be judged
  double damping_stddev, stiffness_stddev;  ///< of ln(1 + change); NaN: not known
  std::optional<double> distance_from_load;  ///< distanceFromLoad(); empty: no payload is possible

  /// @return standard deviation of x1 - x0, of two that are measured.
  double apartStddev() const;
};

/// @param both  two that are measured.
/// @param range  of ln of the body's mass over that of the healthy vehicle, from the lightest to the heaviest that
/// payload makes it.
/// @return distance of both changes from those by the load that explains them best, in standard deviations: by weighted
/// least squares over the range, with the joint covariance.
double distanceFromLoad(const MeasuredChange& both, const std::pair<double, double>& range);

/// Tells payload from damage. b1 = beta/M and b0 = K/M: a mass that is m times as large (ln m = p) moves both by -p,
/// damage moves one:  x1 = ln(b1/b1n) = d - p,  x0 = ln(b0/b0n) = s - p.
/// Of the many (p, d, s) that explain (x1, x0) this is the one of least |p - q| + |d| + |s|, with q the load that was
/// there before: p = median(q, -x1, -x0). So what both have in common is payload, and what one has beyond it is damage;
/// and a vehicle that was lighter and then has lost damping is not one that was loaded and has a stiffer spring. What
/// is not significant of p - q counts as none: it is shrunk by 1 - (2 sigma / (p - q))^2, at least 0 (L. Breiman,
/// Better subset regression using the nonnegative garrote, 1995), so that the noise of b0 does not enter the size of a
/// damage. Payload alone is the rival of every damage (distanceFromLoad()): a damage is no more significant than it is
/// certain that no payload explains the same. So a damping that is certainly lower is not yet the damper's fault as
/// long as the stiffness may be as much lower.
/// @param payload_range  largest relative change of mass that can be payload; what is beyond is damage. 0: none is.
/// @param known_load  q.
StrutChange splitChange(const MeasuredChange& measured, double payload_range, double known_load);

/// @return a report of these changes and their standard deviations, and of nothing else.
HealthReport reportOf(const StrutChange& change);

/// Lets a level pass once it has lasted for the confirm time. While levels alternate that are all worse (or all better)
/// than the confirmed one, the one nearest to it counts as lasting, so that noise at a threshold hides nothing.
/// Cost per level: O(1), no allocation.
class LevelConfirmation {
 public:
  /// @param stamp  stamps that go back restart the confirmation.
  /// @return the confirmed level.
  HealthLevel update(Stamp stamp, HealthLevel now, Stamp confirm_time);

 private:
  HealthLevel confirmed_ = HealthLevel::kStale;
  HealthLevel pending_ = HealthLevel::kStale;
  Stamp pending_since_{};
};

/// Page's cumulative sum (E. S. Page, Continuous inspection schemes, Biometrika 1954) of the log likelihood ratio of a
/// relative change of twice the reference r against none, both ways:
///   S+ <- max(0, S+ + 2 r (x - r) / sigma^2),  S- <- max(0, S- + 2 r (-x - r) / sigma^2),  alarm at S >= h.
/// It adds up small changes that no single estimate could prove. h = ln(2 N) for at least N values in the mean between
/// two false alarms, by G. Lorden (Procedures for reacting to a change in distribution, Annals of Mathematical
/// Statistics 1971): one sum gives at least exp(h), a sum each way alarms twice as often. Values
/// are taken for uncorrelated: correlated ones would alarm oftener (R. A. Johnson, M. Bagshaw, The effect of serial
/// correlation on the performance of CUSUM tests, Technometrics 16 (1974), 103-112). Cost per value: O(1), no
/// allocation.
class EarlyWarning {
 public:
  /// @param reference  changes below it are of no interest [-].
  /// @param values_between_false_alarms  N, >= 2.
  EarlyWarning(double reference, double values_between_false_alarms);

  /// @param change  x [-].  @param stddev  sigma; a value whose sigma is not known says nothing.
  /// @return isOn().
  bool add(double change, double stddev);

  /// @return true from the alarm on until the sum is back at 0.
  bool isOn() const { return fall_.on || rise_.on; }

 private:
  struct Sum {
    double value = 0.0;
    bool on = false;
    void add(double step, double threshold);
  };

  double reference_, threshold_;
  Sum fall_, rise_;
};

/// Takes the lag of an estimate away where the strut changes steadily: an estimate is about the strut of `age` ago.
///
/// A straight line by weighted least squares through the newest changes, each at the time of its data. Estimates whose
/// windows overlap share their errors, so that each counts only by the part of its window that is new. Where the slope
/// is significant the newest change is carried on by it, by no more than kLeastChange, so that a small step does not
/// look large. Cost per change: O(kChanges), no allocation.
class ChangeTrend {
 public:
  /// @param change  the newest one.  @param age  of its data [s].
  /// @param now  a time that increases [s].  @param window  span of the data [s].
  /// @return the change as it is now.
  Measured carryOn(const Measured& change, double age, double now, double window);

  void restart() { points_.clear(); }

 private:
  static constexpr std::size_t kChanges = 16;  // over four windows that share no reading

  struct Point {
    double time, size, weight;
  };

  boost::circular_buffer<Point> points_{kChanges};
  double last_ = 0.0;
};

}  // namespace suspension_health_monitor
