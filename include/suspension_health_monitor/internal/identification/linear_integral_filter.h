#pragma once

#include <vector>

#include "suspension_health_monitor/internal/identification/horizon_integral.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// Size and rule of a linear integral filter; the same for every signal of one regression.
struct IntegralFilterOptions {
  int horizon_samples = 30;  ///< L, horizon h = L T
  double period = 0.02;      ///< sampling time T [s]
  IntegrationRule rule = IntegrationRule::kBandLimited;
};

/// Linear integral filter: the n-fold finite-horizon integral of the r-th derivative of a sampled signal,
///   I_r^n x(k) = (1 - q^-L)^r J^(n-r) x(k),   J x = integral of x over the newest L sampling intervals.
/// With the trapezoid rule this is Eq. (9), since (1 - q^-1)(1 + q^-1 + ... + q^(-L+1)) = 1 - q^-L.
/// A derivative needs no integration rule: r = n is an exact difference. Every factor is late by as much as the rule is
/// (HorizonIntegral), so that all outputs belong to the same time, n of it behind the newest sample.
///
/// Source: Eq. (8)-(9); Sagara and Zhao (1990).
/// Cost per push: O(n), independent of L, no allocation. No drift, see HorizonIntegral.
class LinearIntegralFilter {
 public:
  /// @param order  n >= 1.
  /// @param lowest_derivative  smallest r that will be asked for, 0 <= r <= n; a larger one saves work.
  /// @throws std::invalid_argument  naming the argument, its value and what is allowed.
  LinearIntegralFilter(int order, const IntegralFilterOptions& options, int lowest_derivative = 0);

  void push(double sample);

  /// @return how many samples make an output, n (L + 2 lateness) + 1.
  static int window(int order, const IntegralFilterOptions& options) {
    return order * (options.horizon_samples + 2 * HorizonIntegral::lateness(options.rule)) + 1;
  }

  /// @return true once a window of samples has been pushed: initial conditions no longer reach the output.
  bool full() const { return missing_ == 0; }

  /// @param derivative  r, lowest_derivative <= r <= n.
  /// @return I_r^n x, n lateness samples ago [unit of x times s^(n-r)].
  double output(int derivative) const;

  void reset();

 private:
  int order_;
  int horizon_;
  int lateness_;  // of every factor [samples]
  int window_;
  int missing_;  // samples until it is full
  std::vector<HorizonIntegral> integrals_;
  std::vector<DelayLine> lines_;  // lines_[i] holds J^i x
};

}  // namespace suspension_health_monitor
