#pragma once

#include <optional>

namespace suspension_health_monitor {

/// Follows one parameter of the strut through the values that a forgetting estimator gives, without its lag.
///
/// Double exponential smoothing (R. G. Brown, Smoothing, Forecasting and Prediction of Discrete Time Series, 1963,
/// ch. 9): s1 <- s1 + g (x - s1), s2 <- s2 + g (s1 - s2). Level 2 s1 - s2 follows a ramp without delay, its slope is
/// g / (1 - g) (s1 - s2) per step; the value now is the level carried on by the slope over the lag of x.
/// A value that is far from the level is a step, not a trend: the trend then begins anew there, and does not overshoot.
/// Cost per step: O(1), no allocation.
class ParameterTrend {
 public:
  /// @param gain  g in (0, 1): one over the memory in steps.
  /// @param lag  of the values behind the parameter, in steps.
  ParameterTrend(double gain, double lag) : gain_(gain), lag_(lag) {}

  /// The next value x.
  /// @param stddev  of x; a level more than kStep of them away is left for x. NaN: it is left for every x.
  void follow(double value, double stddev);

  /// A step without a value that could be trusted: on along the slope.
  void coast();

  /// @return the parameter now; empty before the first value.
  std::optional<double> now() const;

 private:
  static constexpr double kStep = 5.0;

  double level() const { return 2.0 * once_ - twice_; }

  double gain_, lag_;
  double once_ = 0.0, twice_ = 0.0;
  double steps_ = 0.0;  // since the trend began
};

}  // namespace suspension_health_monitor
