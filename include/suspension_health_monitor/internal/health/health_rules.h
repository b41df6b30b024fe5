#pragma once

#include <boost/circular_buffer.hpp>
#include <cstddef>

#include "suspension_health_monitor/internal/health/strut_change.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Lets a level pass once it has lasted for the confirm time. While levels alternate that are all worse (or all better)
/// than the confirmed one, the one nearest to it counts as lasting, so that noise at a threshold hides nothing.
/// Cost per level: O(1), no allocation.
class LevelConfirmation {
 public:
  explicit LevelConfirmation(Stamp confirm_time) : confirm_time_(confirm_time) {}

  void setConfirmTime(Stamp confirm_time) { confirm_time_ = confirm_time; }

  /// @param stamp  stamps that go back restart the confirmation.
  /// @return the confirmed level.
  HealthLevel update(Stamp stamp, HealthLevel now);

 private:
  Stamp confirm_time_;
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
/// is significant the newest change is carried on by it, by no more than kMostCarried, so that a small step does not
/// look large. Cost per change: O(kChanges), no allocation.
class ChangeTrend {
 public:
  /// @param change  the newest one.  @param age  of its data [s].
  /// @param now  a time that increases [s].  @param window  span of the data [s].
  /// @param certain  standard deviations that a slope must have to be one.
  /// @return the change as it is now.
  LogChange carryOn(const LogChange& change, double age, double now, double window, double certain);

  void restart() { points_.clear(); }

 private:
  static constexpr std::size_t kChanges = 16;  // over four windows that share no reading
  static constexpr double kMostCarried = 0.03;

  struct Point {
    double time, size, weight;
  };

  boost::circular_buffer<Point> points_{kChanges};
  double last_ = 0.0;
};

}  // namespace suspension_health_monitor
