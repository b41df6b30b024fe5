#pragma once

namespace suspension_health_monitor {

/// Page's cumulative sum (E. S. Page, Continuous inspection schemes, Biometrika 1954) over a relative change, both ways:
///   S+ <- max(0, S+ + (x - r) / sigma),  S- <- max(0, S- + (-x - r) / sigma),  alarm at S >= h,
/// with reference r = max(reference, sigma / 2). It adds up small changes that no single estimate could prove.
/// h comes from the wanted mean number of values N between two false alarms, by D. Siegmund (Sequential Analysis, 1985,
/// (2.57)) for the least reference k = 1/2 in units of sigma:
///   N = (exp(2 k b) - 2 k b - 1) / (2 k^2),  b = h + 1.166; a sum each way alarms twice as often.
/// Assumes: values that are not correlated, so far apart that the estimator has forgotten.
/// Cost per value: O(1), no allocation.
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

  double threshold() const { return threshold_; }  ///< h

 private:
  struct Sum {
    double value = 0.0;
    bool on = false;
    void add(double step, double threshold);
  };

  double reference_, threshold_;
  Sum fall_, rise_;
};

}  // namespace suspension_health_monitor
