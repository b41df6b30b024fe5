#pragma once

namespace suspension_health_monitor {

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

}  // namespace suspension_health_monitor
