#pragma once

#include <Eigen/Core>
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
  static constexpr int kWidth = 2 * BandlimitedInterpolator::kHalfWidth;

  /// @param from, to  ends of the step in samples, 0 <= from < to <= 1.  @param period  T [s].
  WheelInterpolator(double from, double to, double period);

  /// @param around  kWidth samples of w'' [m/s^2], the oldest first; the step begins `from` after number kWidth / 2 - 1.
  WheelStep operator()(const double* around) const {
    Eigen::Array<double, 2, 4> sums = Eigen::Array<double, 2, 4>::Zero();
#pragma GCC unroll 12  // counting would cost a third of the sums; a compiler that does not know it may go on
    for (Eigen::Index i = 0; i < kWidth / 2; ++i) {
      const Eigen::Array2d pair(around[2 * i], around[2 * i + 1]);
      for (Eigen::Index row = 0; row < 4; ++row) sums.col(row) += weights_.col(4 * i + row) * pair;
    }
    const auto total = [&](Eigen::Index row) { return sums(0, row) + sums(1, row); };
    return {total(0), total(1), total(2), total(3)};
  }

 private:
  Eigen::Array<double, 2, 2 * kWidth> weights_;  // of two samples for the numbers of a WheelStep, then of the next two
};

/// One step of the strut under the wheel's motion:
///   d'' = w'' - z''(d, v, t, s),   s_j' = g_j.
/// Only the body's part of the motion is integrated numerically (classical Runge-Kutta); the wheel's part, which
/// oscillates much faster, comes in as what it exactly is in the middle and at the end. A step is taken in parts where a
/// memory forgets faster than that, by as many as 32.
/// @pre model.effects.size() <= StrutState::kMostEffects.
void integrateStrut(const StrutModel& model, double time, double step, const WheelStep& wheel, StrutState& state);

}  // namespace suspension_health_monitor
