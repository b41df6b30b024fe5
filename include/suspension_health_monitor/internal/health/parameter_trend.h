#pragma once

#include <optional>

#include "suspension_health_monitor/internal/health/strut_change.h"

namespace suspension_health_monitor {

/// A parameter of the strut, as it is known.
struct UncertainValue {
  double value;
  double stddev;
};

/// Follows one parameter of the strut through the values that a forgetting estimator gives, without its lag.
///
/// A straight line by discounted least squares (R. G. Brown, Smoothing, Forecasting and Prediction of Discrete Time
/// Series, 1963, ch. 9), each value weighted by its inverse variance, so that poor ones hardly count: least sum of
/// exp(-age / memory) (x - a + b age)^2 / variance. The value now is a + b lag, since x tells what was `lag` steps ago.
/// Values in a row share most of their rows: their errors are correlated by exp(-steps / lag). What that makes of the
/// variance is taken from values that are all as good (shareOfErrors()); it grows while there are none or poor ones. A
/// strut loses no more than a tenth of its parameter per memory (standard deviation of the slope beforehand). A faster
/// change is a step: a value that is far from the line begins a new one, and the line is carried on by no more than
/// kMostCarried, so that a small step does not look large. Cost per step: O(1), no allocation.
class ParameterTrend {
 public:
  /// @param memory  in steps, above 1.  @param lag  of the values behind the parameter, in steps, above 0.
  ParameterTrend(double memory, double lag) { setMemory(memory, lag); }

  /// From the next value on, as in the constructor, for values of an estimator that forgets by another factor; what has
  /// been taken in keeps its weight.
  void setMemory(double memory, double lag);

  /// The next value x.
  /// @param variance  of x, above 0; 0, NaN or infinite: it tells nothing.
  void follow(double value, double variance);

  /// A step without a value.
  void pass();

  /// @return variance of the mean of many now(), so many steps apart, over that of uncorrelated ones (1 + 2 sum of the
  /// correlations), of a trend as in the constructor while the parameter stays.
  static double varianceOfMeans(double memory, double lag, double steps);

  /// @return the parameter now; empty before the first value.
  std::optional<UncertainValue> now() const;

 private:
  static constexpr double kStep = 5.0;          // standard deviations
  static constexpr double kSlope = 0.1;         // of the value per memory
  static constexpr double kMostCarried = 0.03;  // of the value

  struct Line {
    double level, slope;  // at the newest step; per step
    double level_variance;
    double unit;  // of the covariance's other entries
  };

  void forget();
  void fit();

  /// @return variance of the line so many steps after the newest one.
  double varianceAhead(double steps) const {
    return line_.level_variance + steps * (2.0 * age_ + steps * weight_) * line_.unit;
  }

  double memory_, lag_;
  double correlated_;                                    // steps for which an error counts
  double weight_ = 0.0, age_ = 0.0, age_squared_ = 0.0;  // sums, weighted
  double sum_ = 0.0, sum_age_ = 0.0;                     // of x and of x times age, weighted
  Line line_{};                                          // through them
};

/// One parameter of the strut, followed by the trends of LS and of LA at once. LS lags a change by one memory of the
/// estimator, LA by about three (doc/uncertainty.md: its slope rho), but outliers hardly touch it. Of their two trends
/// the one counts that knows the parameter better. Estimators that never forget, or do not know their standard
/// deviations, have no trend: LA as it is counts. Cost per update: O(1), no allocation.
class FollowedParameter {
 public:
  /// @param memory  of the estimators, in updates; infinite: they never forget.  @param horizon  of their filter, in
  /// updates.
  FollowedParameter(double memory, double horizon);

  /// From the next values on, for estimators that forget by another factor for the time being.
  /// @param memory, horizon  as in the constructor; finite.
  void setMemory(double memory, double horizon);

  /// @return variance of the mean of many changes of a healthy strut, so many updates apart, over that of uncorrelated
  /// ones, where LA's trend counts, the longer one; 1 for estimators that never forget.
  static double varianceOfMeans(double memory, double horizon, double updates);

  /// @param ls  empty: not valid.
  void follow(const std::optional<UncertainValue>& ls, const UncertainValue& la);

  /// @param healthy  value and standard deviation of the healthy strut.
  /// @param certain  standard deviations from which a change is certain: of two that are, the larger one counts.
  /// @return the change from it; empty before the first estimate, or while the parameter is not above 0.
  std::optional<LogChange> changeFrom(const UncertainValue& healthy, double certain) const;

 private:
  bool forgets_;
  ParameterTrend ls_, la_;
  std::optional<UncertainValue> newest_;  // of LA
};

}  // namespace suspension_health_monitor
