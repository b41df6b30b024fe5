#pragma once

#include <boost/circular_buffer.hpp>
#include <vector>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/model/strut_integrator.h"
#include "suspension_health_monitor/internal/signal/delay_line.h"

namespace suspension_health_monitor {

/// Travel and travel rate of a strut from its relative acceleration u = w'' - z'' alone, integrated twice.
///
/// The unknown first travel and rate, and the noise of the sensors, make the integrals drift. A washout forgets what is
/// slower than a fiftieth of the natural frequency, d'' = u - 2 zeta omega d' - omega^2 d, at which the phase at the
/// natural frequency is right to 3 %. The rest of the drift, which is slower than the strut moves, is taken off as the
/// mean of the mean of the mean over a natural period. That has no phase, but is late by a period and a half.
/// Cost per sample: O(1), no allocation.
class TravelObserver {
 public:
  /// @param period  T [s].  @param stiffness_to_mass  b0 > 0 of the strut [1/s^2].
  /// @param natural_period  that the means are taken over [samples], even.
  TravelObserver(double period, double stiffness_to_mass, int natural_period);

  /// Takes in the next sample of an uninterrupted uniform series [m/s^2].
  void push(double relative_acceleration);

  bool full() const { return slow_.front().full(); }

  static int delayOf(int natural_period);  ///< [samples]

  /// At the sample so much before the newest one, once full():
  double travel() const { return fast(0); }      ///< d [m]
  double travelRate() const { return fast(1); }  ///< v [m/s]
  /// What of the relative acceleration that travel belongs to [m/s^2]: the rest of it is slower than is observed.
  double acceleration() const { return fast(2); }

  /// After a gap.
  void startNewSeries();

 private:
  double fast(std::size_t which) const;

  double period_, washout_, horizon_;
  WheelInterpolator step_;
  LimitedMean offset_;           // between the sensors
  double age_ = 0.0;             // of the series [s]
  std::array<double, 3> now_{};  // travel, rate, acceleration
  DelayLine input_{WheelInterpolator::kWidth};
  std::vector<LinearIntegralFilter> slow_;
  std::vector<boost::circular_buffer<double>> recent_;
};

}  // namespace suspension_health_monitor
