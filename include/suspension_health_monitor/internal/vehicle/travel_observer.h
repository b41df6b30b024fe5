#pragma once

#include <boost/circular_buffer.hpp>
#include <vector>

#include "suspension_health_monitor/internal/identification/limited_mean.h"
#include "suspension_health_monitor/internal/model/strut_integrator.h"
#include "suspension_health_monitor/internal/signal/sliding_window.h"
#include "suspension_health_monitor/internal/vehicle/slow_mean.h"

namespace suspension_health_monitor {

/// Travel and travel rate of a strut from its relative acceleration u = w'' - z'' alone, integrated twice.
///
/// The unknown first travel and rate, and the noise of the sensors, make the integrals drift. A washout forgets what is
/// slower than a two hundredth of the natural frequency, d'' = u - 2 zeta omega d' - omega^2 d, at which the phase at
/// the natural frequency is right to 1 %. The rest of the drift is taken off as a SlowMean, late by a natural period
/// and a half. Cost per sample: O(1), no allocation.
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

  /// After a gap.
  void startNewSeries();

 private:
  double fast(std::size_t which) const;

  double period_, washout_;
  WheelInterpolator step_;
  LimitedMean offset_;           // between the sensors
  double age_ = 0.0;             // of the series [s]
  std::array<double, 2> now_{};  // travel, rate
  SlidingWindow<WheelInterpolator::kWidth> input_;
  std::vector<SlowMean> slow_;
  std::vector<boost::circular_buffer<double>> recent_;
};

}  // namespace suspension_health_monitor
