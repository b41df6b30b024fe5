#pragma once

#include <cstddef>

#include "suspension_health_monitor/internal/model/strut_integrator.h"
#include "suspension_health_monitor/internal/signal/sliding_window.h"

namespace suspension_health_monitor {

/// Travel and travel rate of a strut from its relative acceleration u = w'' - z'' alone, integrated twice. What is
/// slower than the washout is forgotten, d'' = u - 2 zeta omega d' - omega^2 d, as are the unknown first travel and rate.
/// Between samples u is interpolated, so the answer comes kDelay samples late.
/// Cost per sample: O(1), no allocation.
class TravelObserver {
 public:
  static constexpr int kDelay = BandlimitedInterpolator::kHalfWidth;  ///< samples
  static constexpr double kDamping = 0.7;                             ///< zeta

  /// @param period  T [s].
  explicit TravelObserver(double period) : period_(period), step_(0.0, 1.0, period) {}

  /// @param frequency  omega, below which travel is forgotten [rad/s].
  void setWashout(double frequency) { washout_ = frequency; }

  /// Takes in the next sample of an uninterrupted uniform series [m/s^2].
  void push(double relative_acceleration);

  bool full() const { return input_.full(); }  ///< 2 kDelay samples have come

  /// At the sample kDelay before the newest one.
  double travel() const { return travel_; }           ///< d [m]
  double travelRate() const { return travel_rate_; }  ///< v [m/s]

  /// After a gap.
  void startNewSeries();

 private:
  double period_;
  WheelInterpolator step_;
  double washout_ = 0.0;
  double age_ = 0.0;  // of the series [s]
  double travel_ = 0.0, travel_rate_ = 0.0;
  SlidingWindow<WheelInterpolator::kWidth> input_;
};

}  // namespace suspension_health_monitor
