#pragma once

#include <array>
#include <vector>

#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// How the integral of a sampled signal is formed. All three are exact on a linear signal.
enum class IntegrationRule {
  kTrapezoid,    ///< the paper's rule (9): straight lines between samples, error O(T^2)
  kSimpson,      ///< a parabola through every pair of intervals, error O(T^4); needs an even L.
                 ///< Davis & Rabinowitz, Methods of Numerical Integration, 2nd ed. (1984), eq. (2.2.2)
  kBandLimited,  ///< the trapezoid rule with corrections at both ends, of up to kMostCorrections samples each, that
                 ///< are exact on parabolas, error O(T^4), and of least error on what oscillates with up to half of
                 ///< the Nyquist frequency; any L >= 5. Gregory's corrections (ibid., sec. 2.9), which are for smooth
                 ///< signals, are 9 % wrong on a wheel that hops at a quarter of the rate
};

/// J x(t) = integral of x over [t - h, t], h = L T, on samples: one factor of the operator (8).
///
/// A weighted sum of the newest L + 1 samples whose weights are constant inside the horizon and corrected at its ends,
/// so that a running sum does it: cost per sample O(1), whatever L.
/// A running sum alone would collect rounding errors for ever; here it is replaced after every L + 1 samples by one
/// that was gathered afresh without any subtraction, so an error (or the trace of a huge outlier) lives 2 (L + 1)
/// samples at most.
class HorizonIntegral {
 public:
  /// @param intervals  L, number of sampling intervals in the horizon; see IntegrationRule for what a rule needs.
  /// @param period  sampling time T > 0 [s].
  /// @throws std::invalid_argument  naming intervals or period, the value and what is allowed.
  HorizonIntegral(int intervals, double period, IntegrationRule rule);

  /// Length that the delay line given to update() must have.
  int requiredHistory() const { return intervals_ + 2; }

  /// Takes in the newest sample of `signal`.
  /// @param signal  delay line of at least requiredHistory() samples, to which the sample has just been pushed.
  /// @return the integral over the newest L intervals [unit of the signal times s].
  double update(const DelayLine& signal);

  void reset();

 private:
  static constexpr int kMostCorrections = 8;

  int intervals_;
  double period_;
  double same_weight_ = 1.0;             // of taps at an even distance from the newest sample, inside the horizon
  double other_weight_ = 1.0;            // of taps at an odd distance
  std::vector<double> end_corrections_;  // of either end sample, its neighbour, ...
  // Running sums over the window by parity of the sample's index, and the ones that will replace them.
  std::array<double, 2> sums_{};
  std::array<double, 2> fresh_{};
  int until_refresh_;
  std::size_t parity_ = 0;           // of the newest sample
  std::size_t leaves_other_parity_;  // 1: the sample that leaves the window is of the other parity
};

}  // namespace suspension_health_monitor
