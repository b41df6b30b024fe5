#pragma once

#include <vector>

#include "suspension_health_monitor/internal/math/delay_line.h"

namespace suspension_health_monitor {

/// How the integral of a sampled signal is formed. Both are exact on a linear signal.
enum class IntegrationRule {
  kTrapezoid,   ///< the paper's rule (9): straight lines between samples, error O(T^2)
  kBandLimited  ///< the trapezoid rule with corrections by the samples on either side of both ends: exact on cubics,
                ///< error O(T^4), and within 0.4 % on what oscillates with up to 0.7 of the Nyquist frequency
};

/// J x(t) = integral of x over [t - h, t], h = L T, on samples: one factor of the operator (8).
///
/// A sum over the horizon, and a correction at either end of it:
///   J x = T ((1 + q^-1 + ... + q^-(L-1)) x + E x - q^-L E x),   E x = -x / 2 + sum c_k (q^-k - q^k) x,
/// so that a running sum does it: cost per sample O(1), whatever L. As it needs the samples after the end, too, the
/// result is lateness() samples late.
/// A running sum alone would collect rounding errors for ever; here it is replaced after every L samples by one that
/// was gathered afresh without any subtraction, so an error (or the trace of a huge outlier) lives 2 L samples at most,
/// once it is in the sum.
class HorizonIntegral {
 public:
  /// @param intervals  L, number of sampling intervals in the horizon.
  /// @param period  sampling time T > 0 [s].
  /// @throws std::invalid_argument  naming intervals or period, the value and what is allowed.
  HorizonIntegral(int intervals, double period, IntegrationRule rule);

  /// @return by how many samples the end of the horizon is behind the newest sample.
  static int lateness(IntegrationRule rule);

  /// Length that the delay line given to update() must have.
  int requiredHistory() const { return intervals_ + 2 * lateness_ + 1; }

  /// Takes in the newest sample of `signal`.
  /// @param signal  delay line of at least requiredHistory() samples, to which the sample has just been pushed.
  /// @return the integral over the L intervals that end lateness() samples ago [unit of the signal times s].
  double update(const DelayLine& signal);

  void reset() {
    ends_.reset();
    sum_ = fresh_ = 0.0;
    until_refresh_ = intervals_;
  }

 private:
  int intervals_;
  double period_;
  int lateness_;
  std::vector<double> corrections_;  // c_1, c_2, ...
  DelayLine ends_;                   // E x
  double sum_ = 0.0;                 // of the newest L samples up to the end, and the one that will replace it
  double fresh_ = 0.0;
  int until_refresh_;
};

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

  void push(double sample) {
    lines_.front().push(sample);
    for (std::size_t i = 0; i < integrals_.size(); ++i) lines_[i + 1].push(integrals_[i].update(lines_[i]));
  }

  /// @return how many samples make an output, n (L + 2 lateness) + 1.
  static int window(int order, const IntegralFilterOptions& options) {
    return order * (options.horizon_samples + 2 * HorizonIntegral::lateness(options.rule)) + 1;
  }

  /// @return true once a window of samples has been pushed: initial conditions no longer reach the output.
  bool full() const { return lines_.front().full(); }

  /// @param derivative  r, lowest_derivative <= r <= n.
  /// @return I_r^n x, n lateness samples ago [unit of x times s^(n-r)].
  double output(int derivative) const;

  void reset() {
    for (HorizonIntegral& integral : integrals_) integral.reset();
    for (DelayLine& line : lines_) line.reset();
  }

 private:
  int order_;
  int horizon_;
  int lateness_;  // of every factor [samples]
  std::vector<HorizonIntegral> integrals_;
  std::vector<DelayLine> lines_;  // lines_[i] holds J^i x
};

}  // namespace suspension_health_monitor
