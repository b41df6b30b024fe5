#pragma once

#include <array>
#include <cmath>

#include "suspension_health_monitor/model/strut_model.h"
#include "suspension_health_monitor/signal/bandlimited_interpolator.h"

namespace suspension_health_monitor {

/// Travel, travel rate and the memories of the effects.
struct StrutState {
  static constexpr std::size_t kMostEffects = 8;

  double travel = 0.0;       ///< d [m]
  double travel_rate = 0.0;  ///< v [m/s]
  std::array<double, kMostEffects> memory{};

  bool finite() const { return std::isfinite(travel) && std::isfinite(travel_rate); }
};

/// What the wheel does during one integration step, beyond going on with the speed that it had: the gains of its
/// position [m] and velocity [m/s] by the middle and by the end of the step.
struct WheelStep {
  double middle_position = 0.0, middle_velocity = 0.0, end_position = 0.0, end_velocity = 0.0;
};

/// Turns samples of w'' into wheel steps.
class WheelInterpolator {
 public:
  /// @param from, to  ends of the step in samples, 0 <= from < to <= 1.  @param period  T [s].
  WheelInterpolator(double from, double to, double period);

  /// @param around  2 BandlimitedInterpolator::kHalfWidth samples of w'' [m/s^2].
  WheelStep operator()(const double* around) const;

 private:
  double period_;
  BandlimitedInterpolator middle_position_, middle_velocity_, end_position_, end_velocity_;
};

/// One step of the strut under the wheel's motion:
///   d'' = w'' - z''(d, v, t, s),   s_j' = g_j.
/// Only the body's part of the motion is integrated numerically (classical Runge-Kutta); the wheel's part, which
/// oscillates much faster, comes in as what it exactly is in the middle and at the end.
/// @pre model.effects.size() <= StrutState::kMostEffects.
void integrateStrut(const StrutModel& model, double time, double step, const WheelStep& wheel, StrutState& state);

}  // namespace suspension_health_monitor
