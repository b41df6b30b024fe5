#pragma once

#include <vector>

#include "suspension_health_monitor/internal/signal/delay_line.h"

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

  void reset();

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

}  // namespace suspension_health_monitor
